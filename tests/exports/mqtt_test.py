#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Robots on a broker, driven to their goals by `quadrille export --to vda5050 --states -`: all orders
keep to the schema, everybody arrives, and nobody begins a move before those that lead it have ended.

usage: mqtt_test.py <quadrille> <mosquitto> <schema>
"""
import json
import pathlib
import socket
import subprocess
import sys
import tempfile
import threading
import time

import jsonschema
import paho.mqtt.client as mqtt

program, mosquitto, schema_file = sys.argv[1:]
validator = jsonschema.Draft7Validator(json.loads(pathlib.Path(schema_file).read_text()))
robots_program = pathlib.Path(__file__).with_name("mqtt_robots.py")


def run(*arguments, codes=(0,)):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode in codes, (arguments, done.returncode, done.stderr)
    return done


def start_broker(folder):
    """On a port that is free; somebody else may take it before the broker does."""
    for _ in range(5):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        config = pathlib.Path(folder, "mosquitto.conf")
        config.write_text(f"listener {port} 127.0.0.1\nallow_anonymous true\npersistence false\nlog_dest none\n")
        broker = subprocess.Popen([mosquitto, "-c", config], stderr=subprocess.DEVNULL)
        for _ in range(600):
            if broker.poll() is not None:
                break
            try:
                socket.create_connection(("127.0.0.1", port), timeout=1).close()
                return broker, port
            except OSError:
                time.sleep(0.05)
        broker.kill()
        broker.wait()
    sys.exit("no broker starts")


def drive(port, instance, plan, count, seed):
    """What happened, and the orders that were sent."""
    releaser = subprocess.Popen(
        [program, "export", "--instance", instance, "--to", "vda5050", "--states", "-", plan],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, bufsize=1)
    robots = subprocess.Popen([sys.executable, robots_program, str(port), str(count), str(seed)],
                              stdout=subprocess.PIPE, text=True)
    client, is_subscribed = mqtt.Client(client_id="control"), threading.Event()

    def hear(_client, _data, message):
        try:
            releaser.stdin.write(message.payload.decode() + "\n")
            releaser.stdin.flush()
        except (BrokenPipeError, ValueError):
            pass  # All have arrived, or its end says why not.

    client.on_message = hear
    client.on_subscribe = lambda *arguments: is_subscribed.set()
    client.connect("127.0.0.1", port)
    client.subscribe(f"vda5050/v3/fleet{seed}/+/state", qos=1)
    client.loop_start()
    try:
        assert is_subscribed.wait(60), "no answer of the broker"
        assert robots.stdout.readline() == "ready\n"
        # Robots that give up end it.
        threading.Thread(target=lambda: (robots.wait(), releaser.stdin.close()), daemon=True).start()
        orders = []
        for line in releaser.stdout:
            order = json.loads(line)
            validator.validate(order)
            orders.append(order)
            client.publish(f"vda5050/v3/fleet{seed}/{order['serialNumber']}/order", line, qos=1)
        assert releaser.wait(60) == 0, releaser.stderr.read()
        text = robots.stdout.read()
        assert robots.wait(60) == 0, "the robots' errors are above"
        return json.loads(text), orders
    finally:
        client.disconnect()
        client.loop_stop()
        for process in (releaser, robots):
            process.kill()
            process.wait()


def violations(events, precedences):
    when = {(robot, move, what): k for k, (robot, move, what) in enumerate(events)}
    return [p for p in precedences["precedences"]
            if when[p["leader"]["agent"], p["leader"]["move"], "end"]
            > when[p["follower"]["agent"], p["follower"]["move"], "begin"]]


def check(events, precedences):
    moves = [[robot, move, what] for robot, of_robot in enumerate(precedences["moves"])
             for move in range(len(of_robot)) for what in ("begin", "end")]
    assert sorted(events) == sorted(moves), "not all have made all of their moves"
    assert violations(events, precedences) == []
    # The check is one that can fail: everybody in turn, the last one first.
    in_turn = sorted(events, key=lambda event: -event[0])
    return len(violations(in_turn, precedences)) > 0


with tempfile.TemporaryDirectory() as folder:
    instance, plan = f"{folder}/instance.json", f"{folder}/plan.json"
    broker, port = start_broker(folder)
    try:
        driven = updates = seed = matters = 0
        while driven < 4:
            seed += 1
            assert seed < 60, "hardly a plan without a cycle of moves"
            run("generate", "--kind", "roadmap", "--vertices", "40", "--agents", "8", "--mixed", "--seed",
                str(seed), "--instance-output", instance)
            run("solve", "--instance", instance, "--gap", "1000", "--quiet", "--plan", plan, codes=(0, 10))
            checked = run("execute-check", "--instance", instance, "--json", "-", plan, codes=(0, 1))
            if checked.returncode == 1:
                continue
            precedences = json.loads(checked.stdout)
            events, orders = drive(port, instance, plan, 8, seed)
            matters += check(events, precedences)
            updates += sum(order["orderUpdateId"] > 0 for order in orders)
            driven += 1
        assert updates >= 20, f"only {updates} updates"
        assert matters >= 3, "the order of robots hardly matters"
        print(f"{driven} fleets driven, {updates} updates of orders")
    finally:
        broker.terminate()
        broker.wait()
