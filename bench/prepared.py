# SPDX-License-Identifier: MIT
"""Campaigns over instances of the data folder and others that are made beside them."""
import csv
import pathlib
import subprocess
import sys

CAMPAIGNS = pathlib.Path(__file__).resolve().parent / "campaigns"


def link_data(data, folder):
    """`folder`/movingai, and `folder` itself; what is there stays."""
    folder.mkdir(parents=True, exist_ok=True)
    link = folder / "movingai"
    if not link.exists():
        link.symlink_to((data / "movingai").resolve())
    return link


def run(program, name, folder, options, data=None):
    """Runs what is left of campaigns/`name`.yaml, in `folder`/`name`; the rows of its table.
    The instances are those of `data`, or of `folder`."""
    manifest, campaign = str(CAMPAIGNS / f"{name}.yaml"), folder / name
    common = [manifest, "--data", str(data or folder), "--folder", str(campaign)]
    subprocess.run([program, "campaign", "run", *common, *options], check=True, stdout=sys.stderr)
    subprocess.run([program, "campaign", "merge", *common], check=True, stdout=subprocess.DEVNULL)
    with open(campaign / "merged" / "table.csv", newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def is_closed(row):
    return row["status"] == "optimal"


def gap(row):
    """In per cent; None without a plan."""
    return 100 * (float(row["cost"]) / float(row["lower_bound"]) - 1) if row["cost"] else None


def gap_cell(rows, of_all):
    """A cell of a table: `of_all` gaps of what is not closed; empty if all is."""
    gaps = [gap(row) for row in rows if not is_closed(row)]
    return "no plan" if None in gaps else f"{of_all(gaps):.2f} %" if gaps else ""
