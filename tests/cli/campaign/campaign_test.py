# SPDX-License-Identifier: MIT
"""quadrille campaign on tiny instances: what it asks, what becomes of it when things go wrong, what
merge notices, and what it writes.

usage: campaign_test.py <the program quadrille>
"""
import csv
import html.parser
import io
import json
import os
import random
import re
import resource
import shutil
import signal
import sys
import time
import unittest
import xml.etree.ElementTree

from support import PATIENCE, CampaignCase

CampaignCase.program = os.path.abspath(sys.argv[1])


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise AssertionError("nothing happens")
        time.sleep(0.01)


def children_of(pid):
    with open(f"/proc/{pid}/task/{pid}/children", encoding="utf-8") as file:
        return [int(child) for child in file.read().split()]


def is_running(pid):
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
            return file.read().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


class Manifests(CampaignCase):
    def test_jobs_have_the_same_names_wherever_the_data_is(self):
        manifest = self.manifest(systems="dpll: ''\n  mdd: --system mdd-sat",
                                 more="seeds: 0-1\n")
        here = self.jobs(manifest)
        self.assertEqual(len(here), 2 * 2 * 3 * 2 * 2)
        self.assertIn(("alpha", "random-2", 5, "mdd"), here.values())
        os.rename(self.data, self.path("elsewhere"))
        there = self.campaign("list", manifest, "--data", self.path("elsewhere"))
        self.assertEqual(list(here), [line.split("\t")[0] for line in there.splitlines()])
        with open(self.path("elsewhere/alpha-random-1.scen"), "a", encoding="utf-8") as file:
            file.write("\n")  # another file
        changed = self.campaign("list", manifest, "--data", self.path("elsewhere")).splitlines()
        kept = set(here) & {line.split("\t")[0] for line in changed}
        self.assertEqual({here[name][:2] for name in kept},
                         {("alpha", "random-2"), ("beta", "random-1"), ("beta", "random-2")})

    def test_names_do_not_change_from_version_to_version(self):
        self.write("data/one.map", "type octile\nheight 1\nwidth 2\nmap\n..\n")
        self.write("data/one-random-1.scen", "version 1\n0\tone.map\t2\t1\t0\t0\t1\t0\t1\n")
        manifest = self.write("one.yaml", """data: data
instances: [{maps: one.map, scenarios: "{map}-*.scen", agents: [1]}]
systems: {dpll: --system dpll}
limits: {cpu: 30, memory: 4096}
""")
        # If this fails, campaigns of users forget what they have done.
        self.assertEqual(list(self.jobs(manifest)), ["afcc52b8a05e38c6"])

    def test_what_is_wrong_is_named_with_its_line(self):
        good = self.read(os.path.basename(self.manifest()))
        for old, new, line, message in (
                ("stop: first", "stop: soon", 6, "stop has to be first, half, none or never"),
                ("stop: first", "halt: first", 6, "'halt' is no key of a manifest"),
                ("stop: first", "stop: first\nstop: half", 7, "'stop' is there twice"),
                ("agents: 2:8:3", "agents: 8:2:3", 5, "ascending numbers"),
                ("agents: 2:8:3", "agents: 2,9", 5, "alpha random-1 has 8 agents only"),
                ("agents: 2:8:3", "agents: {from: 2}", 5, "either a step or a factor"),
                ("agents: 2:8:3", "agents: {from: 2, factor: 1}", 5, "a number above 1"),
                ("agents: 2:8:3", "agent: 2", 5, "'agent' is no key of an entry of instances"),
                ("*.map", "*.mop", 3, "no file matches"),
                ("dpll: ''", "dpll: --json x", 8, "the option --json is the campaign's own"),
                ("dpll: ''", "dpll: ''\n  x: ''", 9, "asks the same as"),
                ("dpll: ''", "dpll: ''\n  dpll: --audit", 9, "'dpll' is there twice"),
                ("cpu: 20", "cpu: much", 9, "cpu has to be a number above 0"),
                ("cpu: 20", "gpu: 20", 9, "'gpu' is no key of limits"),
                ("data: data", "data: [", 3, "not valid YAML"),
                ("data: data", "slurm: {chunk: 0}", 1, "chunk has to be a whole number"),
        ):
            with self.subTest(new):
                self.assertIn(old, good)
                manifest = self.write("wrong.yaml", good.replace(old, new))
                out = self.campaign("list", manifest, code=65)
                self.assertIn(f"wrong.yaml:{line}: ", out)
                self.assertIn(message, out)
        self.assertIn("cannot", self.campaign("run", self.path("none.yaml"), code=65))
        self.campaign("resume", self.manifest(), code=65)  # nothing to go on with


class Ladders(CampaignCase):
    def test_manifests_have_the_limits_of_all_yaml(self):
        good = self.read(os.path.basename(self.manifest()))
        bomb = "".join(f"  - &{name} [" + ", ".join(["*" + before] * 9) + "]\n"
                       for before, name in zip("abcdefg", "bcdefgh"))
        for more, message in (
                ("title: &a x\n", "anchors are not accepted"),
                ("seeds: &a [1]\nreference: *a\n", "anchors are not accepted"),
                ("seeds:\n  - &a [1]\n" + bomb, "anchors are not accepted"),
                ("reference: *a\n", "not valid YAML"),
                ("title: !!binary x\n", "the tag"),
                ("title: " + "[" * 40 + "]" * 40 + "\n", "nested deeper than 32 levels"),
                ("title: " + "[" * 2000 + "]" * 2000 + "\n", "too many brackets"),
                ("---\ntitle: x\n", "a second document"),
        ):
            with self.subTest(more[:40]):
                out = self.campaign("list", self.write("wrong.yaml", good + more), code=65)
                self.assertIn("wrong.yaml:", out)
                self.assertIn(message, out)

    def test_geometric_ladders_end_with_the_scenario(self):
        agents = {job[2] for job in self.jobs(self.manifest("{from: 2, factor: 1.5}")).values()}
        self.assertEqual(agents, {2, 3, 4, 6, 8})
        agents = {job[2] for job in self.jobs(self.manifest("{from: 1, to: 7, step: 3}")).values()}
        self.assertEqual(agents, {1, 4, 7})
        agents = {job[2] for job in self.jobs(self.manifest("all")).values()}
        self.assertEqual(agents, {8})

    def climb(self, stop, solved, agents):
        """What has to be run, and what may be run: a rung that is decided need not be finished."""
        need, may = set(), set()
        for name in ("alpha", "beta"):
            groups = [[1], [2]] if stop in ("first", "never") else [[1, 2]]
            for group in groups:
                allowed = {"first": 0, "half": 1, "none": 1, "never": 9}[stop]
                for number in agents:
                    rung = {(name, f"random-{s}", number) for s in group}
                    failed = {job for job in rung if number > solved[job[1]]}
                    may |= rung
                    if len(failed) > allowed:
                        need |= failed if len(failed) == len(rung) else set()
                        break
                    need |= rung
        return need, may

    def test_they_end_where_the_rule_says(self):
        random_numbers = random.Random(20261124)
        for stop in ("first", "half", "none", "never"):
            solved = {f"random-{s}": random_numbers.randint(0, 8) for s in (1, 2)}
            table = ",".join(f"{name[7:]}:{most}" for name, most in solved.items())
            manifest = self.manifest("1:7:3", stop, self.fake("table:" + table))
            with self.subTest(stop=stop, solved=solved):
                out = self.campaign("run", manifest, "--jobs", "3")
                jobs = self.jobs(manifest)
                done = {jobs[name][:3] for name in self.rows()}
                need, may = self.climb(stop, solved, [1, 4, 7])
                self.assertLessEqual(need, done)
                self.assertLessEqual(done, may)
                left = len(jobs) - len(done)
                self.assertIn(f"{left} not needed", out)
                shutil.rmtree(self.path("m.campaign"))


class Trouble(CampaignCase):
    def test_a_killed_worker_is_tried_again_once(self):
        manifest = self.manifest("3", systems=self.fake("sleep-at-first"))
        run = self.start("campaign", "run", manifest, "--jobs", "4")
        wait_until(lambda: len(self.starts()) == 4)
        for child in children_of(run.pid):
            os.kill(child, signal.SIGKILL)
        out, err = run.communicate(timeout=PATIENCE)
        self.assertEqual(run.returncode, 0, out + err)
        self.assertEqual(set(self.starts().values()), {2})
        self.assertEqual({row["status"] for row in self.rows().values()}, {"infeasible"})

    def test_one_that_is_killed_twice_is_a_row_that_says_so(self):
        manifest = self.manifest("3", systems=self.fake("sleep"))
        run = self.start("campaign", "run", manifest, "--jobs", "4")
        for starts in (4, 8):
            wait_until(lambda: sum(self.starts().values()) == starts)
            for child in children_of(run.pid):
                os.kill(child, signal.SIGKILL)
        run.communicate(timeout=PATIENCE)
        self.assertEqual({(row["status"], row["explanation"]) for row in self.rows().values()},
                         {("failed", "ended by signal 9 2 times")})

    def test_a_killed_campaign_loses_nothing_and_takes_its_workers_along(self):
        manifest = self.manifest("1:8:1", systems=self.fake("nap"))
        for kills in range(3):
            run = self.start("campaign", "run", manifest, "--jobs", "3")
            wait_until(lambda: len(self.lines()) >= 6 * (kills + 1))
            workers = children_of(run.pid)
            os.kill(run.pid, signal.SIGKILL)
            run.communicate(timeout=PATIENCE)
            wait_until(lambda: not any(is_running(worker) for worker in workers))
            before = self.lines()
            with open(self.path("m.campaign/results.jsonl"), "a", encoding="utf-8") as file:
                file.write('{"job":"00')  # as if it had been killed in the middle of a line
        self.campaign("resume", manifest, "--jobs", "3")
        self.assertEqual(len(self.rows()), 32)
        self.assertEqual(self.lines()[:len(before)], before)
        self.campaign("run", manifest)
        self.assertEqual(len(self.rows()), 32)

    def test_two_at_a_time_share_the_work(self):
        manifest = self.manifest("1:8:1", systems=self.fake("nap"))
        self.campaign("list", manifest)
        runs = [self.start("campaign", "run", manifest, "--jobs", "2") for _ in range(3)]
        for run in runs:
            out, err = run.communicate(timeout=PATIENCE)
            self.assertEqual(run.returncode, 0, out + err)
            self.assertIn("32 of at most 32 jobs", out)
        self.assertEqual(len(self.rows()), 32)
        self.assertEqual(set(self.starts().values()), {1}, "a job was run twice")

    def test_random_kills_lose_and_double_nothing(self):
        random_numbers = random.Random(7)
        manifest = self.manifest("1:8:1", "never", self.fake("nap"))
        runs = [self.start("campaign", "run", manifest, "--jobs", "2") for _ in range(3)]
        for _ in range(10):
            time.sleep(random_numbers.uniform(0.05, 0.3))
            victim = runs.pop(random_numbers.randrange(3))
            victim.kill()
            victim.communicate(timeout=PATIENCE)
            runs.append(self.start("campaign", "run", manifest, "--jobs", "2"))
        for run in runs:
            out, err = run.communicate(timeout=PATIENCE)
            self.assertEqual(run.returncode, 0, out + err)
            self.assertIn("32 of at most 32 jobs", out)
        self.assertEqual(len(self.rows()), 32)
        self.assertEqual(len(self.lines()), 32, "a damaged line")

    def test_an_interrupt_stops_cleanly_and_resume_goes_on(self):
        manifest = self.manifest("1:8:1", systems=self.fake("sleep-at-first"))
        run = self.start("campaign", "run", manifest, "--jobs", "4")
        wait_until(lambda: len(self.starts()) == 4)
        workers = children_of(run.pid)
        status = self.campaign("status", manifest, code=30)
        self.assertIn("running    4", status)
        run.send_signal(signal.SIGINT)
        out, err = run.communicate(timeout=PATIENCE)
        self.assertEqual(run.returncode, 30, out + err)
        self.assertIn("goes on", out)
        self.assertFalse(any(is_running(worker) for worker in workers))
        self.assertEqual(self.rows(), {})
        # The second start of these four answers at once; of the others the first one is killed.
        resumed = self.start("campaign", "resume", manifest, "--jobs", "4")
        while resumed.poll() is None:
            if len(self.rows()) >= 4:
                break
            time.sleep(0.01)
        resumed.send_signal(signal.SIGTERM)
        resumed.communicate(timeout=PATIENCE)
        self.assertEqual(resumed.returncode, 30)
        self.assertGreaterEqual(len(self.rows()), 4)

    def test_a_signal_for_all_that_reaches_the_workers_first_begins_nothing(self):
        # Slurm signals the processes of a task one after the other, in any order.
        for behaviour, sent in (("sleep", signal.SIGTERM), ("sleep", signal.SIGKILL),
                                ("polite", signal.SIGTERM)):
            manifest = self.manifest("1:8:1", systems=self.fake(behaviour), name=behaviour + ".yaml")
            with self.subTest(behaviour=behaviour, sent=sent):
                before = sum(self.starts().values())
                run = self.start("campaign", "run", manifest, "--jobs", "2")
                wait_until(lambda: sum(self.starts().values()) == before + 2)
                workers = children_of(run.pid)
                for worker in workers:
                    os.kill(worker, sent)
                wait_until(lambda: not set(workers) & set(children_of(run.pid)))
                time.sleep(0.3)
                run.terminate()
                out, err = run.communicate(timeout=PATIENCE)
                self.assertEqual(run.returncode, 30, out + err)
                self.assertEqual(sum(self.starts().values()), before + 2, "one more was begun")
                self.assertEqual(self.rows(behaviour + ".campaign"), {})

    def test_limits_are_enforced_from_outside(self):
        for behaviour, limits, stop in (("deaf", "wall: 0.3", "wall-time"),
                                        ("spin", "cpu: 0.3", "cpu-time"),
                                        ("hog", "memory: 64", "memory")):
            with self.subTest(behaviour):
                manifest = self.write(behaviour + ".yaml", f"""data: data
instances: [{{maps: alpha.map, scenarios: "{{map}}-random-1.scen", agents: 1}}]
systems: {{{self.fake(behaviour)}}}
limits: {{{limits}, grace: 0.5}}
""")
                self.campaign("run", manifest)
                row, = self.rows(behaviour + ".campaign").values()
                self.assertEqual((row["status"], row["stop_reason"], row["enforced"]),
                                 ("unknown", stop, True))

    def test_limits_of_the_program_itself(self):
        hard = self.path("data/hard.map")
        self.quadrille("generate", "--kind", "random", "--width", "24", "--height", "24", "--seed",
                       "5", "--map-output", hard, "--scen-output",
                       self.path("data/hard-random-1.scen"), "--agents", "180")
        for limits, stop in (("cpu: 0.2", "cpu-time"), ("memory: 1", "memory"),
                             ("conflicts: 1", "conflicts")):
            name = stop + ".yaml"
            manifest = self.write(name, f"""data: data
instances: [{{maps: hard.map, scenarios: "{{map}}-*.scen", agents: [180]}}]
limits: {{{limits}}}
""")
            self.campaign("run", manifest)
            row, = self.rows(stop + ".campaign").values()
            self.assertIn(row["status"], ("feasible", "unknown"))
            self.assertEqual((row["stop_reason"], row["enforced"]), (stop, False))

    def test_what_is_no_answer_is_a_row_that_says_so(self):
        for behaviour, why in (("nonsense", "not a result"), ("crash", "bad luck")):
            manifest = self.manifest("1", systems=self.fake(behaviour), name=behaviour + ".yaml")
            self.campaign("run", manifest, code=1)  # Every job failed.
            for row in self.rows(behaviour + ".campaign").values():
                self.assertEqual(row["status"], "failed")
                self.assertIn(why, row["explanation"])
        manifest = self.manifest("1", systems="none: {program: /no/such/program}", name="none.yaml")
        self.assertIn("cannot start /no/such/program", self.campaign("run", manifest, code=74))
        self.assertEqual(self.rows("none.campaign"), {})

    def test_failed_jobs_are_opened_again_and_others_are_not(self):
        calm = self.fake("nap").replace("fake:", "calm:").replace("starts", "others")
        systems = self.fake("crash-at-first") + "\n  " + calm
        manifest = self.manifest("1-3", "never", systems)
        self.campaign("run", manifest, "--jobs", "4")
        self.assertIn("fake: 0 solved, 0 not, 12 failed", self.campaign("status", manifest))
        self.assertIn("12 jobs are open", self.campaign("reopen", manifest))
        self.assertIn("0 jobs are open", self.campaign("reopen", manifest))
        status = self.campaign("status", manifest, code=30)
        self.assertIn("left       at most 12", status)
        self.assertNotIn("fake:", status)
        self.campaign("merge", manifest, code=30)
        self.assertEqual(len(self.table()), 12)
        self.campaign("resume", manifest, "--jobs", "4")
        self.assertEqual(set(self.starts().values()), {2})
        status = self.campaign("status", manifest)
        self.assertIn("calm: 12 solved, 0 not, 0 failed", status)
        self.assertIn("fake: 12 solved, 0 not, 0 failed", status)
        self.campaign("merge", manifest)
        self.assertEqual([row["status"] for row in self.table() if row["system"] == "fake"],
                         ["infeasible"] * 12)

    def test_a_ladder_that_ended_with_a_failure_goes_on(self):
        manifest = self.manifest("1-3", "first", self.fake("crash-at-first"))
        for rung in range(3):
            # Only the first time has no job an answer.
            self.campaign("run", manifest, "--jobs", "4", code=1 if rung == 0 else 0)
            self.assertEqual(len(self.starts()), 4 * (rung + 1))
            self.assertIn("4 jobs are open", self.campaign("reopen", manifest))
        self.campaign("run", manifest)
        self.assertEqual({row["status"] for row in
                          [json.loads(line) for line in self.lines()][-4:]}, {"infeasible"})

    def test_a_full_disk_ends_the_run_and_leaves_whole_rows(self):
        manifest = self.manifest("1:8:1")
        self.campaign("run", manifest, "--jobs", "2")
        complete = self.rows()
        os.remove(self.path("m.campaign/results.jsonl"))
        limit = 4000

        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        out = self.campaign("resume", manifest, "--jobs", "2", code=74, preexec_fn=small_files)
        self.assertIn("results.jsonl: cannot write: File too large", out)
        text = self.read("m.campaign/results.jsonl")
        self.assertTrue(text.endswith("\n"))
        self.assertTrue(0 < len(text) <= limit)
        before = self.rows()
        self.assertTrue(0 < len(before) < len(complete))
        self.campaign("resume", manifest, "--jobs", "2")
        self.assertEqual({name: row["cost"] for name, row in self.rows().items()},
                         {name: row["cost"] for name, row in complete.items()})

    def test_damaged_lines_are_run_again(self):
        manifest = self.manifest("2,5")
        self.campaign("run", manifest)
        lines = self.lines()
        damaged = [line[:40] + "\0" * 20 + line[60:] if number == 2 else line
                   for number, line in enumerate(lines)]
        self.write("m.campaign/results.jsonl", "\n".join(damaged) + "\n")
        self.assertIn("damaged    1 lines", self.campaign("status", manifest, code=30))
        self.campaign("run", manifest)
        self.campaign("merge", manifest)
        self.assertEqual(len(self.table()), len(lines))


class Merging(CampaignCase):
    def merged(self, change, code=1):
        """What merge says when the rows are changed by `change`, a function of their list."""
        rows = [json.loads(line) for line in self.good]
        change(rows)
        self.write("m.campaign/results.jsonl", "".join(json.dumps(row) + "\n" for row in rows))
        return self.campaign("merge", self.path("m.yaml"), code=code)

    def find(self, rows, *job):
        name = next(name for name, asked in self.all.items() if asked == job)
        return next(row for row in rows if row["job"] == name)

    def test_contradictions_are_named(self):
        manifest = self.manifest("3,6", systems="dpll: ''\n  mdd: --system mdd-sat")
        self.campaign("run", manifest, "--jobs", "2")
        self.good, self.all = self.lines(), self.jobs(manifest)
        dpll, mdd = ("alpha", "random-1", 6, "dpll"), ("alpha", "random-1", 6, "mdd")
        fewer = ("alpha", "random-1", 3, "dpll")
        self.assertIn("16 plans replayed, no contradictions", self.merged(lambda rows: None, 0))

        def bound(rows):
            row = self.find(rows, *mdd)
            row["lower_bound"] = row["exact_bound"] = row["exact_bound"] + 1
            row["status"] = "feasible"

        def bound_of_fewer(rows):
            row = self.find(rows, *fewer)
            row["exact_bound"] = 10000

        def unequal(rows):
            row = self.find(rows, *dpll)
            row["lower_bound"] = row["exact_bound"] = row["exact_bound"] - 1

        def cost(rows):
            self.find(rows, *dpll)["exact_cost"] -= 1

        def no_plan(rows):
            self.find(rows, *dpll)["plan"] = None

        def path(rows):
            plan = self.find(rows, *dpll)["plan"]
            plan[0], plan[1] = plan[1], plan[0]

        def off_the_grid(rows):
            self.find(rows, *dpll)["plan"][0] += "99u"

        def infeasible(rows):
            self.find(rows, *fewer).update(status="infeasible", cost=None, exact_cost=None,
                                           lower_bound=None, exact_bound=None, plan=None)

        def twice(rows):
            rows.append(self.find(rows, *dpll))

        for change, message, jobs in (
                (bound, "has the lower bound", [dpll, mdd]),
                (bound_of_fewer, "has the lower bound 10000", [fewer, dpll]),
                (unequal, "is optimal with cost", [dpll]),
                (cost, "it says that its plan costs", [dpll]),
                (no_plan, "has no plan", [dpll]),
                (path, "its plan is not valid", [dpll]),
                (off_the_grid, "its plan leaves the grid", [dpll]),
                (infeasible, "says infeasible", [fewer]),
                (twice, "has two rows", [dpll])):
            with self.subTest(change.__name__):
                out = self.merged(change)
                self.assertIn("contradiction: ", out)
                self.assertIn(message, out)
                for name in jobs:
                    self.assertIn(next(n for n, job in self.all.items() if job == name), out)

    def test_the_reference_counts(self):
        self.write("data/reference.csv", "map,random_scen,agents,optimal_sum_of_costs,other_cpu_s\n"
                   "alpha,1,3,1,0.5\nbeta,1,3,,>30\n")
        manifest = self.manifest("3", more="reference: reference.csv\n")
        self.campaign("run", manifest)
        out = self.campaign("merge", manifest, code=1)
        self.assertIn("than the optimal cost of the reference, 1", out)
        cost = next(row["cost"] for name, row in self.rows().items()
                    if self.jobs(manifest)[name][:2] == ("alpha", "random-1"))
        self.write("data/reference.csv", "map,random_scen,agents,optimal_sum_of_costs,other_cpu_s\n"
                   f"alpha,1,3,{cost},0.5\nbeta,1,3,,>30\n")
        self.campaign("merge", manifest)
        self.assertIn("other (reference)", self.read("m.campaign/merged/report.html"))
        self.write("data/reference.csv", "map,agents\nalpha,1\n")
        self.assertIn("reference.csv:1: ", self.campaign("merge", manifest, code=65))

    def read_scenario(self, name, agents):
        with open(os.path.join(self.data, name + ".scen"), encoding="utf-8") as file:
            rows = [line.split() for line in file][1:agents + 1]
        return [tuple(int(number) for number in row[4:8]) for row in rows]

    def test_tables_and_tracker(self):
        manifest = self.manifest("2:8:2", systems="dpll: ''\n  smt: --system smt-cbs")
        self.campaign("run", manifest, "--jobs", "2")
        self.campaign("merge", manifest)
        rows, jobs, table = self.rows(), self.jobs(manifest), self.table()
        self.assertEqual([row["job"] for row in table], [name for name in jobs if name in rows])
        for row in table:
            self.assertEqual((row["map"], row["scenario"], int(row["agents"]), row["system"]),
                             jobs[row["job"]])
            self.assertEqual(row["cost"], str(rows[row["job"]]["cost"]))
            self.assertEqual(row["cpu_limit"], "20.0")
        lines = self.read("m.campaign/merged/table.jsonl").splitlines()
        self.assertEqual([json.loads(line)["job"] for line in lines], [row["job"] for row in table])
        self.check_tracker({(row["map"], row["scenario"], row["agents"]): row for row in table})

    def check_tracker(self, best):
        """Replays the motions of the tracker's table: y grows downwards."""
        text = self.read("m.campaign/merged/tracker.csv")
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(list(rows[0]), ["map_name", "scen_type", "type_id", "agents", "lower_cost",
                                         "solution_cost", "solution_plan"])
        self.assertEqual(len(rows), len(best))
        steps = {"u": (0, -1), "d": (0, 1), "l": (-1, 0), "r": (1, 0), "w": (0, 0)}
        for row in rows:
            self.assertEqual(row["scen_type"], "random")
            scenario = f"random-{row['type_id']}"
            known = best[row["map_name"], scenario, row["agents"]]
            self.assertEqual((row["lower_cost"], row["solution_cost"]),
                             (known["lower_bound"], known["cost"]))
            tasks = self.read_scenario(f"{row['map_name']}-{scenario}", int(row["agents"]))
            paths = row["solution_plan"].split("\n")
            self.assertEqual(len(paths), len(tasks))
            total = 0
            for (x, y, goal_x, goal_y), path in zip(tasks, paths):
                self.assertRegex(path, r"^(([2-9]|[1-9]\d+)?[udlrw])*$")
                motions = "".join(letter * int(times or 1)
                                  for times, letter in re.findall(r"(\d*)([udlrw])", path))
                for motion in motions:
                    x, y = x + steps[motion][0], y + steps[motion][1]
                self.assertEqual((x, y), (goal_x, goal_y))
                total += len(motions)
            self.assertEqual(str(total), row["solution_cost"])

    def test_the_report_is_one_well_formed_file(self):
        manifest = self.manifest("2:8:2", systems="dpll: ''\n  '<smt> & co': --system smt-cbs",
                                 more="title: <tiny> & more\n")
        self.campaign("run", manifest)
        self.campaign("merge", manifest)
        text = self.read("m.campaign/merged/report.html")
        self.assertIn("<h1>&lt;tiny&gt; &amp; more</h1>", text)
        open_tags = []

        class Parser(html.parser.HTMLParser):
            def handle_starttag(self, tag, attributes):
                if tag != "meta":
                    open_tags.append(tag)
                for name, address in attributes:
                    if name in ("src", "href"):
                        raise AssertionError(address)  # nothing from elsewhere

            def handle_startendtag(self, tag, attributes):
                pass

            def handle_endtag(self, tag):
                if open_tags.pop() != tag:
                    raise AssertionError(tag)

        Parser().feed(text)
        self.assertEqual(open_tags, [])
        figures = re.findall(r"<svg.*?</svg>", text, re.DOTALL)
        self.assertEqual(len(figures), 1 + 2 + 2)  # cactus, ladders, gaps
        for figure in figures:
            root = xml.etree.ElementTree.fromstring(figure)
            curves = root.findall("{http://www.w3.org/2000/svg}polyline")
            self.assertTrue(curves)
            for curve in curves:
                for point in curve.get("points").split():
                    x, y = map(float, point.split(","))
                    self.assertTrue(0 <= x <= float(root.get("width")))
                    self.assertTrue(0 <= y <= float(root.get("height")))

    def test_histories_end_with_the_answer(self):
        manifest = self.manifest("6")
        self.campaign("run", manifest)
        for row in self.rows().values():
            times = [point[0] for point in row["history"]]
            bounds = [point[1] for point in row["history"]]
            self.assertEqual(times, sorted(times))
            self.assertEqual(bounds, sorted(bounds))
            self.assertEqual(row["history"][-1][1:], [row["lower_bound"], row["cost"]])
        instance = ["--map", os.path.join(self.data, "alpha.map"), "--scen",
                    os.path.join(self.data, "alpha-random-1.scen"), "--agents", "6"]
        result = self.path("result.json")
        self.quadrille("solve", *instance, "--quiet", "--history", "--json", result)
        self.assertTrue(json.loads(self.read("result.json"))["history"])
        self.quadrille("verify", *instance, "--quiet", result)  # It is read like any other.
        self.quadrille("solve", *instance, "--history", code=64)

    def test_roadmaps_and_files(self):
        os.mkdir(self.path("data/square"))
        grid = "<row>0 0 0 0</row>" * 4
        self.write("data/square/map.xml", "<root><map><width>4</width><height>4</height>"
                   f"<grid>{grid}</grid></map></root>")
        self.write("data/square/task_1.xml", '<root><agent id="0" start_i="0" start_j="0" '
                   'goal_i="3" goal_j="3"/><agent id="1" start_i="3" start_j="0" goal_i="0" '
                   'goal_j="3"/></root>')
        self.quadrille("generate", "--kind", "roadmap", "--vertices", "12", "--agents", "2",
                       "--instance-output", self.path("data/discs.json"))
        self.quadrille("convert", "--map", self.path("data/alpha.map"), "--scen",
                       self.path("data/alpha-random-1.scen"), "--agents", "3", "--to", "yaml",
                       "--output", self.path("data/grid.yaml"))
        manifest = self.write("m.yaml", """data: data
instances:
  - {roadmaps: "*/map.xml", tasks: "{folder}/task_*.xml", agents: "1-2", options: --neighbourhood 2}
  - {files: discs.json}
  - {files: "*.yaml"}
systems: {dpll: "", makespan: --objective makespan}
limits: {cpu: 20}
""")
        self.campaign("run", manifest)
        self.assertIn("8 plans replayed, no contradictions", self.campaign("merge", manifest))
        self.assertEqual({row["map"] for row in self.table()}, {"square", "discs", "grid"})
        text = self.read("m.campaign/results.jsonl")
        self.write("m.campaign/results.jsonl", text.replace('"depart_ticks":', '"depart_ticks":1', 1))
        self.campaign("merge", manifest, code=1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
