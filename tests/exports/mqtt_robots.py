#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Robots that carry out orders of VDA 5050: they go along released edges, each with random delays of its
own, and say at which node they are. In the end, one JSON list of [robot, move, "begin" or "end"] in the
order in which it happened. What an order or an update may not say is an error.

usage: mqtt_robots.py <port> <number of robots> <seed>
"""
import json
import os
import queue
import random
import sys
import threading
import time

import paho.mqtt.client as mqtt

port, count, seed = (int(argument) for argument in sys.argv[1:])
lock = threading.Lock()
events = []


def fail(text):
    """At once, whatever the other robots wait for."""
    print(text[:1000], file=sys.stderr, flush=True)
    os._exit(1)


class Robot(threading.Thread):
    def __init__(self, number):
        super().__init__(daemon=True)
        self.number, self.name = number, f"agent{number}"
        self.random = random.Random(seed * 1000 + number)
        self.orders, self.is_subscribed = queue.Queue(), threading.Event()
        self.order, self.edges, self.base, self.at, self.last = None, {}, 0, 0, None
        self.client = mqtt.Client(client_id=f"robot{number}")
        self.client.on_message = lambda client, data, message: self.orders.put(json.loads(message.payload))
        self.client.on_subscribe = lambda *arguments: self.is_subscribed.set()
        self.client.connect("127.0.0.1", port)
        self.client.subscribe(f"vda5050/v3/fleet{seed}/{self.name}/order", qos=1)
        self.client.loop_start()

    def tell(self):
        state = {"serialNumber": self.name, "orderId": self.order["orderId"] if self.order else "",
                 "orderUpdateId": self.order["orderUpdateId"] if self.order else 0,
                 "lastNodeSequenceId": 2 * self.at, "driving": False}
        self.told = self.client.publish(f"vda5050/v3/fleet{seed}/{self.name}/state", json.dumps(state), qos=1)

    def take(self, order):
        """An order, or an update that goes on where the base ended."""
        nodes, edges = order["nodes"], order["edges"]
        if self.order is None:
            assert order["orderUpdateId"] == 0 and nodes[0]["sequenceId"] == 0, order
        else:
            assert order["orderId"] == self.order["orderId"], order
            assert order["orderUpdateId"] == self.order["orderUpdateId"] + 1, order
            assert nodes[0]["sequenceId"] == 2 * self.base, (self.base, order)
            assert nodes[0]["nodeId"] == self.node, (self.node, order)
        assert nodes[0]["released"], order
        released = [edge["released"] for edge in edges]
        assert released == sorted(released, reverse=True), "an edge is released after one that is not"
        assert released == [node["released"] for node in nodes[1:]], order
        if self.order is not None:
            assert released[0], "an update that releases nothing"
        self.base = nodes[0]["sequenceId"] // 2 + sum(released)
        self.node = nodes[sum(released)]["nodeId"]
        self.last = nodes[-1]["sequenceId"] // 2
        self.order = order

    def run(self):
        try:
            self.tell()  # Without an order.
            while self.at != self.last:
                if self.order is None or self.at == self.base:
                    self.take(self.orders.get(timeout=60))
                    self.tell()
                while not self.orders.empty():
                    self.take(self.orders.get())
                if self.at == self.base:
                    continue
                for what in ("begin", "end"):
                    time.sleep(self.random.choice((0, 0.001, 0.002, 0.01)))
                    with lock:
                        events.append([self.number, self.at, what])
                self.at += 1
                self.tell()
            self.told.wait_for_publish(60)  # Disconnecting would drop it.
        except queue.Empty:
            fail(f"{self.name} waits for an order at node {self.at} of {self.last}")
        except Exception as problem:  # Of a thread: the program has to say it.
            fail(f"{self.name}: {problem!r}")
        self.client.disconnect()
        self.client.loop_stop()


robots = [Robot(number) for number in range(count)]
for robot in robots:
    assert robot.is_subscribed.wait(60), f"no answer of the broker for {robot.name}"
print("ready", flush=True)
for robot in robots:
    robot.start()
for robot in robots:
    robot.join()
print(json.dumps(events))
