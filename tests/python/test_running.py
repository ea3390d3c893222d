# SPDX-License-Identifier: MIT
"""What goes on while a search runs: threads, signals, callbacks."""

import signal
import subprocess
import sys
import threading
import time

import pytest
from conftest import random_crowd, random_grid_fleet

import quadrille as q


def test_the_gil_is_released():
    fleet, done = random_crowd(), threading.Event()
    threading.Thread(target=lambda: (q.solve(fleet, time_limit=1.5), done.set())).start()
    rounds = 0
    while not done.is_set():
        rounds += 1
        time.sleep(0.001)
    # With the GIL held there would be a few before the search begins.
    assert rounds > 20


def test_searches_side_by_side_do_not_disturb_each_other():
    fleets = [random_grid_fleet(seed) for seed in range(12)]
    alone = [q.solve(fleet) for fleet in fleets]
    together = [None] * len(fleets)

    def work(i):
        together[i] = q.solve(fleets[i])

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(fleets))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for a, b in zip(alone, together):
        assert (a.status, a.cost, a.plan) == (b.status, b.cost, b.plan)


def test_progress_is_heard_in_the_calling_thread(crowd):
    heard, threads, plans = [], set(), []

    def progress(at):
        heard.append(at)
        threads.add(threading.current_thread())

    result = q.solve(crowd, time_limit=3, progress=progress, progress_interval=0.05,
                     on_plan=plans.append, plan_interval=0)
    assert threads == {threading.current_thread()}
    assert heard and heard == sorted(heard, key=lambda at: (at.elapsed, at.lower_bound))
    assert heard[-1].lower_bound <= result.lower_bound
    assert all(at.gap is None or at.gap >= 0 for at in heard)
    # What is replaced before this thread looks at it is not heard.
    assert heard[-1].phase == "search" and "search, bound" in str(heard[-1])
    costs = [plan.sum_of_costs for plan in plans]
    assert costs == sorted(set(costs), reverse=True) and costs[-1] >= result.cost
    assert all(plan.verify() for plan in plans)
    assert result.stop == "wall-time" and result.status == "feasible"
    assert result.gap == pytest.approx(100 * (result.cost / result.lower_bound - 1))


def test_a_bound_that_is_known():
    resting = 0
    for seed in range(20):
        fleet = random_grid_fleet(seed)
        result = q.solve(fleet)
        if result.status != "optimal":
            continue
        assert not result.rests_on_known_bound
        assert q.solve(fleet, known_bound=result.cost).cost == result.cost
        stopped = q.solve(fleet, known_bound=result.cost, time_limit=0)
        assert stopped.lower_bound == result.cost
        resting += stopped.rests_on_known_bound
    assert resting > 0


def test_exceptions_of_callbacks_come_out(crowd):
    class Enough(Exception):
        pass

    def stop(_):
        raise Enough("of this")

    for arguments in (dict(progress=stop, progress_interval=0), dict(on_plan=stop)):
        with pytest.raises(Enough, match="of this"):
            q.solve(crowd, time_limit=60, **arguments)
    with pytest.raises(SystemExit):
        q.solve(crowd, time_limit=60, progress=lambda _: sys.exit(3), progress_interval=0)
    # A search that was ended leaves nothing behind.
    assert q.solve(random_grid_fleet(1)).status == "optimal"


def test_a_callback_may_solve(crowd):
    inner = []

    def progress(_):
        if not inner:
            inner.append(q.solve(random_grid_fleet(1)).status)

    q.solve(crowd, time_limit=2, progress=progress, progress_interval=0)
    assert inner == ["optimal"]


def interrupted_after(seconds, call):
    timer = threading.Timer(seconds, signal.raise_signal, [signal.SIGINT])
    timer.start()
    try:
        return call()
    finally:
        timer.join()


def test_ctrl_c_raises_with_what_there_is(crowd):
    with pytest.raises(KeyboardInterrupt) as raised:
        interrupted_after(1, lambda: q.solve(crowd, time_limit=100))
    assert isinstance(raised.value, q.Interrupted)
    result = raised.value.result
    assert (result.stop, result.status) == ("interrupt", "feasible")
    assert result.plan.verify()


def test_ctrl_c_may_return_what_there_is(crowd):
    result = interrupted_after(1, lambda: q.solve(crowd, time_limit=100, keep_interrupt=True))
    assert (result.stop, result.status) == ("interrupt", "feasible")
    assert result.plan.verify()


def test_ctrl_c_ends_a_loop_of_solves(crowd):
    rounds = []

    def loop():
        while len(rounds) < 1000:
            rounds.append(q.solve(crowd, time_limit=0.2).status)

    with pytest.raises(KeyboardInterrupt):
        interrupted_after(1, loop)
    assert len(rounds) < 1000


def test_other_signal_handlers_are_heard(crowd):
    class Alarm(Exception):
        pass

    def handler(*_):
        raise Alarm

    previous = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.5)
        with pytest.raises(Alarm):
            q.solve(crowd, time_limit=100)
    finally:
        signal.signal(signal.SIGALRM, previous)


def test_ctrl_c_in_a_process_of_its_own():
    """Also while a roadmap is searched by two threads, and nothing is said by callbacks."""
    code = """
import quadrille as q, sys
xy = [(x, y) for x in range(12) for y in range(12)]
edges = [(a, b) for a in range(144) for b in range(144) if abs(a - b) == 12 or (abs(a - b) == 1 and a // 12 == b // 12)]
fleet = q.Fleet(q.Roadmap(xy, edges), range(0, 120, 2), range(119, 0, -2), radius=0.3)
print("ready", flush=True)
result = q.solve(fleet, threads=2, keep_interrupt=True)
print(result.stop, result.lower_bound > 0, flush=True)
"""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=120)
    finally:
        process.kill()
    assert (out, process.returncode) == ("interrupt True\n", 0)


def test_a_plan_to_begin_with(crowd):
    first = q.solve(crowd, time_limit=1)
    again = q.solve(crowd, time_limit=0.2, initial=first.plan)
    assert again.status == "feasible" and again.cost <= first.cost
    with pytest.raises(q.InputError):
        q.solve(crowd, initial=crowd.plan(first.plan.paths[:, ::-1]))
