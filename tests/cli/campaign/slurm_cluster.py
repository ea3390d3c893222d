# SPDX-License-Identifier: MIT
"""A Slurm of one node in a temporary folder, on loopback, with a munge of its own: nothing of the
system's configuration is read or changed, and several can run side by side."""
import os
import pwd
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PATIENCE = 60
CONF = """ClusterName=quadrille
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MaxArraySize=1001
SlurmdTimeout=10
KillWait=2
InactiveLimit=0
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_min_interval=20000,bf_interval=1
NodeName=node0 NodeHostname={host} NodeAddr=127.0.0.1 CPUs=12 RealMemory=8000 State=UNKNOWN
PartitionName=main Nodes=node0 Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
"""


def program(name):
    """Daemons are in sbin, which is not in everybody's path."""
    path = shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")
    if path is None:
        raise RuntimeError(f"{name} is not installed: scripts/setup does it")
    return path


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """Use it in a `with` statement. `environment` is what programs need to speak to it."""

    def __enter__(self):
        # Short, because names of sockets are, and readable by nobody else.
        self.folder = tempfile.mkdtemp(prefix="qslurm", dir="/tmp")
        self.processes = []
        try:
            self._start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            if process.poll() is None:
                process.terminate()
        for process in reversed(self.processes):
            try:
                process.wait(5)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _start(self):
        for name in ("munge", "state", "spool"):
            os.mkdir(os.path.join(self.folder, name), 0o755)
        os.chmod(self.folder, 0o755)  # munge wants to be seen
        key = os.path.join(self.folder, "munge", "key")
        with open(key, "wb") as file:
            file.write(os.urandom(128))
        os.chmod(key, 0o400)
        self.conf = os.path.join(self.folder, "slurm.conf")
        with open(self.conf, "w", encoding="utf-8") as file:
            file.write(CONF.format(host=socket.gethostname().split(".")[0], folder=self.folder,
                                   user=pwd.getpwuid(os.getuid()).pw_name, ports=free_ports(2)))
        # Nothing here needs control groups, but the node looks for them, and does not start where /sys is not
        # mounted (in a chroot, say), unless it is told to look for those of version 1, and only on demand.
        if not os.path.exists("/sys/fs/cgroup/cgroup.controllers"):
            with open(os.path.join(self.folder, "cgroup.conf"), "w", encoding="utf-8") as file:
                file.write("CgroupPlugin=cgroup/v1\n")
        self.environment = {**os.environ, "SLURM_CONF": self.conf}
        munge = os.path.join(self.folder, "munge")
        self._daemon("munged", "--foreground", "--force", f"--key-file={key}",
                     f"--socket={munge}/socket", f"--pid-file={munge}/pid",
                     f"--log-file={munge}/log", f"--seed-file={munge}/seed")
        self._wait(lambda: os.path.exists(f"{munge}/socket"), "munged")
        self.controller = self._daemon("slurmctld", "-D", "-i", "-f", self.conf)
        self.start_node()

    def _daemon(self, name, *words):
        with open(os.path.join(self.folder, name + ".out"), "a", encoding="utf-8") as out:
            process = subprocess.Popen([program(name), *words], stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=out, env=self.environment)
        self.processes.append(process)
        return process

    def _wait(self, condition, what):
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end or any(p.poll() is not None for p in self.processes[-2:]
                                             if p is not getattr(self, "killed", None)):
                raise RuntimeError(f"{what} does not come up\n{self.logs()}")
            time.sleep(0.05)

    def logs(self):
        """The ends of all logs, for messages."""
        text = ""
        for folder, _, names in os.walk(self.folder):
            for name in names:
                if name.endswith((".log", ".out")) or name == "log":
                    with open(os.path.join(folder, name), encoding="utf-8", errors="replace") as file:
                        text += f"--- {name}\n" + "".join(file.readlines()[-15:])
        return text

    def call(self, name, *words):
        return subprocess.run([program(name), *words], env=self.environment, capture_output=True,
                              text=True, timeout=PATIENCE, check=False)

    def start_node(self):
        self.node = self._daemon("slurmd", "-D", "-N", "node0", "-f", self.conf)
        self._wait(lambda: self.node_state() in ("idle", "mixed", "allocated"), "the node")

    def node_state(self):
        return self.call("sinfo", "-h", "-o", "%T").stdout.strip().rstrip("*~#")

    def kill_node(self):
        """As when a machine loses its power: the daemon, and what it has started."""
        os.kill(self.node.pid, signal.SIGKILL)
        self.node.wait()
        self.processes.remove(self.node)

    def queue(self):
        """Jobs that are not over yet, one line a task."""
        return self.call("squeue", "-h", "-r", "-o", "%i %T").stdout.splitlines()
