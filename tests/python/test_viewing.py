# SPDX-License-Identifier: MIT
"""Pages and pictures of plans: those of the program."""

import html
import re
import xml.etree.ElementTree

import pytest
from conftest import random_grid_fleet, random_roadmap_fleet, run_program, scaled

import quadrille as q


def solved_fleets():
    for seed in range(scaled(12)):
        for fleet in (random_grid_fleet(seed), random_roadmap_fleet(seed)):
            plan = q.solve(fleet, conflict_limit=300).plan if fleet is not None else None
            if plan is not None and len(plan) > 0:
                yield fleet, plan


def test_pages_and_pictures_are_those_of_the_program(tmp_path):
    compared = 0
    for fleet, plan in solved_fleets():
        instance, file = tmp_path / "i.json", tmp_path / "p.json"
        fleet.save(instance)
        plan.save(file)
        page = run_program("view", "--instance", instance, file)
        assert page.returncode == 0, page.stderr
        assert plan.to_html("i.json") == page.stdout
        for kind in ("map", "space-time", "waits"):
            if kind != "waits" and isinstance(fleet.graph, q.Graph):
                continue
            done = run_program(
                "view", "--instance", instance, file, "--output", tmp_path / "page.html", "--svg", "-",
                "--svg-kind", kind, "--svg-agents", "0")
            assert done.returncode == 0, done.stderr
            ours = plan.to_svg(kind, agents=[0])
            assert xml.etree.ElementTree.fromstring(ours).tag.endswith("svg")
            titles = re.compile(r"<title>[^<]*</title>|<text[^>]*class=\"title\"[^>]*>[^<]*</text>")
            assert titles.sub("", ours) == titles.sub("", done.stdout)
            compared += 1
    assert compared > 0


def test_notebooks_show_the_page_in_a_frame():
    for _, plan in solved_fleets():
        frame = plan._repr_html_()
        [page] = re.findall(r'srcdoc="([^"]*)"', frame)
        assert html.unescape(page) == plan.to_html()
        assert 'sandbox="allow-scripts"' in frame


def test_wrong_pictures_are_refused():
    plan = next(plan for _, plan in solved_fleets())
    with pytest.raises(q.InputError, match="'pie' is not map, space-time or waits"):
        plan.to_svg("pie")
    with pytest.raises(IndexError, match=f"there is no agent {len(plan)} among {len(plan)}"):
        plan.to_svg(agents=[len(plan)])
