# SPDX-License-Identifier: MIT
"""Robots that turn on a grid."""

import numpy as np
import pytest

import quadrille as q


def test_poses_have_names() -> None:
    grid = q.Grid([[1, 0], [1, 1]]).with_headings(turn=2)
    assert grid.turn == 2
    assert grid.num_vertices == 12
    assert grid.nodes[:5] == [(0, 0, "east"), (0, 0, "south"), (0, 0, "west"), (0, 0, "north"), (0, 1, "east")]
    assert grid.resolution == (0.01, 1)
    # Each name is where the vertex is.
    assert [tuple(place) for place in grid.xy] == [node[:2] for node in grid.nodes]  # type: ignore[index]
    moves = {(grid.nodes[v], grid.nodes[w]) for v, w in grid.edges if (grid.xy[v] != grid.xy[w]).any()}
    assert moves == {
        ((0, 0, "south"), (0, 1, "south")),
        ((0, 1, "north"), (0, 0, "north")),
        ((0, 1, "east"), (1, 1, "east")),
        ((1, 1, "west"), (0, 1, "west")),
    }
    assert set(grid.durations) == {1, 2}
    assert repr(grid) == "<quadrille.PoseGrid 12 poses, a quarter turn takes 2>"


@pytest.mark.parametrize("turn, cost", [(1, 4 + 3), (3, 7 + 7)])
def test_turns_cost_timesteps(turn: int, cost: int) -> None:
    grid = q.Grid(np.ones((2, 3))).with_headings(turn=turn)
    starts = [(0, 0, "east"), (2, 1, "east")]
    goals = [grid.any_heading(2, 1), (1, 1, "west")]
    fleet = q.Fleet(grid, starts, goals, radius=grid.RADIUS)
    result = q.solve(fleet)
    # Ahead twice, a turn and ahead; half a turn and ahead. Turns of three timesteps make the first one
    # wait for a timestep, until the other has gone.
    assert result.status == "optimal"
    assert result.cost == cost
    assert result.plan is not None
    assert result.plan.verify().valid
    # Without a heading to end with the second may wait for nobody either.
    anywhere = q.Fleet(grid, starts, [grid.any_heading(2, 1), grid.any_heading(1, 1)], radius=0.35)
    assert q.solve(anywhere).cost == cost


def test_what_is_wrong() -> None:
    grid = q.Grid([[1, 0]])
    for turn in (0, -1):
        with pytest.raises(q.InputError, match="a turn takes one timestep or more"):
            grid.with_headings(turn)
    poses = grid.with_headings()
    with pytest.raises(q.InputError, match=r"no vertex called \(1, 0, 'east'\)"):
        poses.any_heading(1, 0)
    with pytest.raises(q.InputError, match="starts"):
        q.Fleet(poses, [(0, 0, "up")], [poses.any_heading(0, 0)], radius=0.35)


def test_robots_that_turn_are_solved_in_timesteps() -> None:
    # With the same costs as in continuous time, where the other system stays.
    grid = q.Grid(np.ones((4, 5))).with_headings(turn=2)
    starts = [(0, 0, "east"), (4, 3, "north"), (2, 1, "west"), (0, 3, "south")]
    goals = [grid.any_heading(4, 3), grid.any_heading(0, 0), grid.any_heading(0, 2), grid.any_heading(3, 0)]
    fleet = q.Fleet(grid, starts, goals, radius=grid.RADIUS)
    result, other = q.solve(fleet), q.solve(fleet, system="smt-cbs")
    assert result.status == other.status == "optimal"
    assert result.cost == other.cost
    assert result.plan is not None and result.plan.verify().valid
    again = q.solve(fleet, initial=result.plan)
    assert again.cost == result.cost
