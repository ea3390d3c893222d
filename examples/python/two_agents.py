# SPDX-License-Identifier: MIT
"""Two agents change places in a row of three cells; there is one more cell below its middle."""

import quadrille as q

grid = q.Grid([[True, True, True], [False, True, False]])
fleet = q.Fleet(grid, starts=[(0, 0), (2, 0)], goals=[(2, 0), (0, 0)])
result = q.solve(fleet)
print(result.status, result.cost)
if result.plan is not None:
    for path in result.plan:
        print(path.name, [(int(x), int(y)) for x, y in path.places])
