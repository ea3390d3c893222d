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
