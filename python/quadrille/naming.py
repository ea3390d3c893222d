# SPDX-License-Identifier: MIT
"""What agents, vertices and groups are called, on the way to files and back."""

from __future__ import annotations

import json
from typing import Any, Hashable, Optional, Union, cast

from . import _core
from ._errors import InputError
from .graphs import Graph, Grid, Roadmap
from .poses import PoseRoadmap


def file_names(graph: Union[Grid, Graph, Roadmap], agents: list[str]) -> _core.Names:
    """For a file: agents that are called by their numbers have no name there."""
    named: list[Optional[str]] = [name if name != str(i) else None for i, name in enumerate(agents)]
    if not any(name is not None for name in named):
        named = []
    if not isinstance(graph, Roadmap):
        return named, [], []
    nodes = graph.nodes if not isinstance(graph, PoseRoadmap) else [_written(node) for node in graph.nodes]
    while nodes and nodes[-1] == len(nodes) - 1:
        nodes.pop()
    vertices = [_as_json(node) for node in nodes]
    groups: list[Optional[str]] = [None, *graph.groups]
    if graph.groups == [str(i + 1) for i in range(len(graph.groups))]:
        groups = []
    return named, vertices, groups


def _written(pose: Any) -> Hashable:
    """A pose in a file, which knows no fractions: a heading that is not whole is a text."""
    place, heading, *role = pose
    return (place, int(heading) if heading.is_integer() else repr(heading), *role)


def place_names(graph: PoseRoadmap) -> list[str]:
    """For messages to others, who call a place alike whatever the heading: as it is called in its own
    roadmap, v0, v1, ... where that is a number."""
    nodes = graph.places.nodes
    return [_as_json(f"v{nodes[at]}" if isinstance(nodes[at], int) else nodes[at]) for at in graph._place_of]


def agent_names(names: _core.Names, n: int) -> list[str]:
    """Of a file."""
    given = names[0] + [None] * (n - len(names[0]))
    return [str(i) if name is None else name for i, name in enumerate(given)]


def group_names(names: _core.Names, numbered: list[str]) -> list[str]:
    """Of a file, where there are as many groups as ``numbered``: their numbers."""
    given = dict(enumerate(names[2][1:]))
    most = max(len(numbered), len(given))
    found: list[str] = []
    for i in range(most):
        name = given.get(i)
        if name is None:
            name = str(i + 1) if str(i + 1) not in given.values() else f"group {i + 1}"
        found.append(name)
    return found


def node_names(names: _core.Names, n: int) -> Optional[list[Hashable]]:
    """Of a file; vertices without a name have their numbers. None: all have."""
    if not names[1]:
        return None
    given: list[Hashable] = [_of_json(json.loads(name)) for name in names[1]]
    known = set(given)
    for number in range(len(given), n):
        # A place of an agent that is under way, which nobody asks for by its name.
        node: Hashable = number if number not in known else ("under way", number)
        given.append(node)
    return given


def _as_json(node: Hashable) -> str:
    return json.dumps(_list_of(node), ensure_ascii=False)


def _list_of(node: Any) -> Any:
    if isinstance(node, tuple):
        return [_list_of(part) for part in node]
    if isinstance(node, str):
        return node
    if isinstance(node, int) and not isinstance(node, bool) and -(2**63) <= node < 2**63:
        return node
    raise InputError(
        f"the node {node!r} cannot be written: files know texts, whole numbers and tuples of these"
    )


def _of_json(value: Any) -> Hashable:
    if isinstance(value, list):
        return tuple(_of_json(part) for part in value)
    return cast(Hashable, value)
