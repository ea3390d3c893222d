# SPDX-License-Identifier: MIT
"""What bench/gaps measured: Markdown tables and a figure.

A rival has no bound of its own: in the figure, its gap is that of its plan to the best bound that Quadrille
has on the row with any of the limits.
"""
from drawing import (INK, LEFT, STYLES, Drawing, Panel, PlotError, half_decades, legend)
from report import line

PANEL_WIDTH, PANEL_HEIGHT = 360, 230
COLUMN, ROW = PANEL_WIDTH + 62, PANEL_HEIGHT + 84
# Per cent; what is below is drawn here, an optimal plan too.
LEAST = 0.1


def is_rival(row):
    return row["rival"] == "yes"


def sum_of_costs(row):
    return row["measure"] == "sum-of-costs"


def group(rows):
    """(family, scenario, agents) -> limit -> program -> row"""
    found = {}
    for row in rows:
        key = (row["family"], row["scenario"], int(row["agents"]))
        found.setdefault(key, {}).setdefault(float(row["cpu_limit"]), {})[row["program"]] = row
    return found


def programs(rows):
    """Names in the order of the file, Quadrille's first."""
    return (list(dict.fromkeys(row["program"] for row in rows if not is_rival(row))),
            list(dict.fromkeys(row["program"] for row in rows if is_rival(row))))


def gap(cost, bound):
    """In per cent; None without a plan or a bound."""
    if cost == "" or bound in ("", "0", None):
        return None
    return 100 * (float(cost) / float(bound) - 1)


def show_plan(row, best):
    if row is None:
        return "-"
    cost = row["cost"]
    if cost == "":
        return "failed" if row["stop_reason"].startswith("signal") else "none"
    return f"**{cost}**" if sum_of_costs(row) and float(cost) == best else cost


def own_cells(row, best):
    """Plan, bound and gap."""
    if row is None:
        return ["-"] * 3
    value = gap(row["cost"], row["lower_bound"])
    return [show_plan(row, best), row["lower_bound"] or "-",
            "-" if value is None else f"{value:.2f}"]


def write_table(runs, own, rivals, file):
    """One line for each instance; the cheapest plan is bold. `runs`: instance -> program -> row."""
    file.write(line(["map, agents"] + [f"{n}: {what}" for n in own for what in
                                       ("plan", "bound", "gap, per cent")] + rivals))
    file.write("|---|" + "--:|" * (3 * len(own) + len(rivals)) + "\n")
    for (family, scenario, agents), found in runs.items():
        best = min((float(row["cost"]) for row in found.values()
                    if sum_of_costs(row) and row["cost"] != ""), default=None)
        title = f"{family}, {agents}" + ("" if scenario == "random-1" else f", {scenario}")
        cells = [cell for name in own for cell in own_cells(found.get(name), best)]
        file.write(line([title] + cells + [show_plan(found.get(name), best) for name in rivals]))
    file.write("\n")


def compare(runs, name, other):
    """How often the plan of `name` costs less, as much and more than that of `other`."""
    counts = [0, 0, 0]
    for found in runs.values():
        if name in found and other in found:
            a, b = (float(found[n]["cost"] or "inf") for n in (name, other))
            counts[0 if a < b else 1 if a == b else 2] += 1
    return counts


def write_tables(rows, file):
    """One table for each limit, and how often Quadrille's plan is the cheaper one."""
    own, rivals = programs(rows)
    groups = group(rows)
    for limit in sorted({limit for by_limit in groups.values() for limit in by_limit}):
        runs = {key: by_limit[limit] for key, by_limit in groups.items() if limit in by_limit}
        file.write(f"CPU limit {limit:g} s\n\n")
        write_table(runs, own, rivals, file)
        for name in own:
            for other in rivals:
                less, same, more = compare(runs, name, other)
                if less + same + more:
                    file.write(f"- {name} beside {other}: cheaper on {less}, equal on {same}, dearer "
                               f"on {more} of {less + same + more} rows\n")
        if own and rivals:
            file.write("\n")


def best_bound(by_limit):
    bounds = [row["lower_bound"] for found in by_limit.values() for row in found.values()
              if row["lower_bound"] != ""]
    return max(bounds, key=float, default=None)


def curves_of(by_limit, own, rivals):
    """name -> [(limit, gap or None)]. Quadrille has two: to its bound at the limit, and, named
    'NAME, best bound', like those of the rivals."""
    bound = best_bound(by_limit)
    curves = {}
    for limit, found in sorted(by_limit.items()):
        for name in own + rivals:
            row = found.get(name)
            if row is None or not sum_of_costs(row):
                continue
            if name in own:
                curves.setdefault(name, []).append((limit, gap(row["cost"], row["lower_bound"])))
                name = f"{name}, best bound"
            curves.setdefault(name, []).append((limit, gap(row["cost"], bound)))
    return curves


def draw_panel(drawing, box, curves, ranges, styles, dashes):
    panel = Panel(drawing, box, *ranges, True, log_x=True)
    panel.x_ticks(sorted({limit for points in curves.values() for limit, _ in points}))
    panel.y_ticks(half_decades(*ranges[1]), " %")
    for name, points in curves.items():
        # A hollow marker at the upper edge: no plan.
        at = [(panel.x(limit), panel.y(ranges[1][1] if value is None else max(value, LEAST)),
               value is None) for limit, value in points]
        line_of = [(x, y) for x, y, none in at if not none]
        if len(line_of) > 1:
            drawing.curve(line_of, styles[name][0], dash=dashes[name])
        for x, y, none in at:
            drawing.marker(x, y, styles[name], hollow=none)


def draw_gaps(rows, path):
    """A panel for each instance: gap over the CPU limit, both logarithmic."""
    own, rivals = programs(rows)
    instances = {key: curves_of(by_limit, own, rivals) for key, by_limit in group(rows).items()
                 if len(by_limit) > 1 and best_bound(by_limit)}
    if not instances:
        raise PlotError("no row has several limits and a bound")
    present = {name for curves in instances.values() for name in curves}
    names = [name for name in own + rivals + [f"{name}, best bound" for name in own]
             if name in present]
    if len(names) > len(STYLES):
        raise PlotError(f"more than {len(STYLES)} curves: choose programs with --program")
    styles = dict(zip(names, STYLES))
    dashes = {name: "6 4" if name.endswith(", best bound") else "" for name in names}
    for name in own:
        if name in styles:
            styles[f"{name}, best bound"] = (styles[name][0], "ring")
    points = [point for curves in instances.values() for curve in curves.values()
              for point in curve]
    limits = [limit for limit, _ in points]
    values = [max(value, LEAST) for _, value in points if value is not None]
    ranges = ((min(limits) / 1.2, max(limits) * 1.2),
              (min(values, default=1) / 1.3, max(values, default=10) * 1.5))
    columns = 2 if len(instances) <= 4 else 3
    drawing, top = Drawing(), 40
    for index, ((family, scenario, agents), curves) in enumerate(instances.items()):
        left, upper = LEFT + index % columns * COLUMN, top + index // columns * ROW
        draw_panel(drawing, (left, upper, PANEL_WIDTH, PANEL_HEIGHT), curves, ranges, styles, dashes)
        title = f"{family}, {agents} agents" + ("" if scenario == "random-1" else f", {scenario}")
        drawing.text(left + PANEL_WIDTH / 2, upper - 12, title, 14, bold=True)
        drawing.text(left + PANEL_WIDTH / 2, upper + PANEL_HEIGHT + 34, "CPU time in s")
    lines = -(-len(instances) // columns)
    width = LEFT + min(columns, len(instances)) * COLUMN
    drawing.text(14, top + (lines * ROW - 84) / 2, "gap: plan above bound", turn=True)
    bottom = top + lines * ROW - 16
    height = bottom + legend(drawing, names, styles, width - LEFT, bottom, dashes, 230)
    drawing.text(LEFT, height + 4, "Solid: a program's plan above its own bound; a rival's, and dashed, "
                 "above Quadrille's best bound. Hollow at the edge: no plan.", 11, "start", INK)
    drawing.write(path, width, height + 18, "Gap over time")
