# SPDX-License-Identifier: MIT
"""quadrille campaign on a real Slurm (slurm_cluster.py): an array of 60 jobs, a node that dies in the
middle, a second submission, and the same table as on one machine.

usage: slurm_test.py <the program quadrille>
"""
import os
import sys
import time
import unittest
from collections import Counter

from slurm_cluster import Cluster
from support import PATIENCE, CampaignCase

CampaignCase.program = os.path.abspath(sys.argv[1])
MEASURED = {"process_cpu_s", "wall_s", "cpu_s", "peak_rss_mib", "host"}


class Slurm(CampaignCase):
    def wait(self, cluster, condition):
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end:
                logs = ""
                for name in sorted(os.listdir(self.path("m.campaign/slurm"))):
                    if name.endswith(".log"):
                        logs += f"--- {name}\n" + self.read(f"m.campaign/slurm/{name}")
                raise AssertionError(f"{cluster.queue()}\n{cluster.logs()}\n{logs[-3000:]}")
            time.sleep(0.1)

    def answers(self):
        """The merged table without what differs from run to run."""
        return [{name: value for name, value in row.items() if name not in MEASURED}
                for row in self.table()]

    def setUp(self):
        super().setUp()
        # Long enough for the node to die while some are running. Written once: a program that runs
        # cannot be written.
        self.slow = self.write("slow", f"#!/bin/sh\necho \"$@\" >>'{self.path('starts')}'\n"
                               f"sleep 0.2\nexec '{self.program}' \"$@\"\n")
        os.chmod(self.slow, 0o755)

    def sixty_jobs(self, chunk):
        systems = "\n  ".join(f"{name}: {{program: {self.slow}, options: --system {name}}}"
                              for name in ("dpll", "smt-cbs", "mdd-sat"))
        return self.manifest("1-5", "never", systems,
                             more=f"slurm: {{partition: main, time: 10, chunk: {chunk}}}\n")

    def test_the_merged_table_is_that_of_a_local_run(self):
        manifest = self.sixty_jobs(chunk=1)
        self.campaign("run", manifest, "--jobs", "4")
        self.campaign("merge", manifest)
        local = self.answers()
        self.assertEqual(len(local), 60)
        os.rename(self.path("m.campaign"), self.path("local"))
        os.remove(self.path("starts"))
        with Cluster() as cluster:
            out = self.campaign("submit", manifest, "--dry-run", env=cluster.environment)
            self.assertIn("--array=0-59", out)
            self.assertIn("--dependency=afterany:ARRAY1", out)
            self.assertEqual(cluster.queue(), [])
            out = self.campaign("submit", manifest, env=cluster.environment)
            self.assertIn("60 tasks in arrays 1, then the merge", out)
            self.wait(cluster, lambda: len(self.lines()) >= 10)
            cluster.kill_node()
            self.assertLess(len(self.lines()), 60)
            cluster.start_node()
            # Somebody is impatient: what is queued already is asked for once more, in large chunks.
            manifest = self.sixty_jobs(chunk=20)
            self.campaign("submit", manifest, env=cluster.environment)
            self.wait(cluster, lambda: cluster.queue() == [])
        self.assertEqual(len(self.rows()), 60)
        self.assertEqual(len(self.read("starts").splitlines()), 60, "a job was run twice")
        self.assertEqual(self.answers(), local)  # as the last merge on the cluster has written it
        self.campaign("status", manifest)
        self.assertIn("nothing is left", self.campaign("submit", manifest))

    def test_a_requeued_task_doubles_nothing(self):
        manifest = self.sixty_jobs(chunk=20)
        with Cluster() as cluster:
            self.campaign("submit", manifest, env=cluster.environment)
            self.wait(cluster, lambda: len(self.lines()) >= 6)
            tasks = [line.split()[0] for line in cluster.queue() if line.endswith("RUNNING")]
            self.assertTrue(tasks)
            requeued = cluster.call("scontrol", "requeue", tasks[0])
            self.assertEqual(requeued.returncode, 0, requeued.stderr)
            self.assertLess(len(self.lines()), 60)
            # It starts again when its old credential has expired: cred_expire of the cluster.
            self.wait(cluster, lambda: cluster.queue() == [])
        self.assertEqual(len(self.rows()), 60)
        # Those of the requeued task that ran just then may have been begun twice, none more often.
        self.assertLessEqual(len(self.read("starts").splitlines()), 61)
        self.assertLessEqual(max(Counter(self.read("starts").splitlines()).values()), 2)
        self.campaign("status", manifest)

    def test_without_slurm(self):
        manifest = self.manifest("2")
        out = self.campaign("submit", manifest, code=74, env={"PATH": self.folder})
        self.assertIn("cannot start sbatch", out)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
