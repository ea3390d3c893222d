# SPDX-License-Identifier: MIT
# A fleet that works for five minutes: tasks keep coming, and robots are late.
import quadrille as q

xy = [(5 * (i % 4), 5 * (i // 4)) for i in range(12)]  # crossings, five metres apart
edges = [(i, i + 1) for i in range(12) if i % 4 < 3] + [(i, i + 4) for i in range(8)]
fleet = q.Fleet(q.Roadmap(xy, edges, both_ways=True), [0, 1, 2, 3], [0, 1, 2, 3], radius=0.6)
dispatcher, done, goal = q.Dispatcher(fleet), 0, 0
for call in range(1500):
    for robot in range(4):
        if dispatcher.num_tasks(robot) == 0:
            goal = (goal + 7) % 12
            dispatcher.assign(robot, goal, service=2)
    done += len(dispatcher.tick(0.2).served)
    for robot in range(4):
        if (call // 5 + robot) % 7 > 0:  # each one stops now and then
            dispatcher.report(robot, dispatcher.limit(robot))
print(done, "tasks are done by", round(dispatcher.now, 3), "s")
