"""A Slurm of one node that a test starts on the loopback interface and ends again: munged, slurmctld and slurmd, with a
folder, a key and ports of their own. No systemd, no cgroups, no database; nothing of a Slurm that is installed
otherwise is touched.
"""

import os
import shutil
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "srun", "scontrol", "sinfo", "squeue")
PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"

CONF = """
ClusterName=private
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={slurmd_port}
SrunPortRange={srun_first}-{srun_last}
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={home}/munge/socket,cred_expire=5
CryptoType=crypto/munge
StateSaveLocation={home}/state
SlurmdSpoolDir={home}/spool
SlurmctldPidFile={home}/slurmctld.pid
SlurmdPidFile={home}/slurmd.pid
SlurmctldLogFile={home}/log/slurmctld
SlurmdLogFile={home}/log/slurmd
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0,sched_min_interval=100000
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
JobRequeue=1
KillWait=5
InactiveLimit=0
MinJobAge=600
MailProg=/bin/true
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=node0 NodeAddr=127.0.0.1 NodeHostname=localhost CPUs={processors} RealMemory=1000 State=UNKNOWN
PartitionName=normal Nodes=node0 Default=YES MaxTime=INFINITE PriorityTier=1 GraceTime=5 PreemptMode=REQUEUE State=UP
PartitionName=urgent Nodes=node0 Default=NO MaxTime=INFINITE PriorityTier=10 PreemptMode=OFF State=UP
"""


def why_not():
    """Why there can be none here; "" when there can."""
    if os.geteuid() != 0:
        return "only root may start a Slurm of its own"
    missing = [program for program in PROGRAMS if not shutil.which(program, path=PATH)]
    return f"{', '.join(missing)} missing: scripts/install-deps --tests (slurm-wlm, munge)" if missing else ""


def free_ports(count):
    """Neighbouring ones that nobody listens at."""
    for _ in range(100):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            first = probe.getsockname()[1]
        if first + count > 65000:
            continue
        try:
            for port in range(first, first + count):
                with socket.socket() as probe:
                    probe.bind(("127.0.0.1", port))
            return first
        except OSError:
            continue
    raise OSError("no free ports")


class NotStarted(Exception):
    pass


class PrivateSlurm:
    def __init__(self, processors):
        self.home = tempfile.mkdtemp(prefix="torquescope_slurm_")
        self.environment = {**os.environ, "PATH": PATH, "SLURM_CONF": self.home + "/slurm.conf"}
        self.daemons = []
        try:
            self.start(processors)
        except BaseException:
            self.end()
            raise

    def start(self, processors):
        home = self.home
        os.chmod(home, 0o755)
        for name in ("munge", "state", "spool", "log"):
            os.mkdir(f"{home}/{name}")
        with open(f"{home}/key", "wb") as file:
            file.write(os.urandom(128))
        os.chmod(f"{home}/key", 0o400)
        port = free_ports(40)
        with open(f"{home}/slurm.conf", "w", encoding="utf-8") as file:
            file.write(CONF.format(home=home, port=port, slurmd_port=port + 1, srun_first=port + 2, srun_last=port + 39,
                                   processors=processors))
        self.daemon("munged", "--foreground", "--force", "--num-threads=2", f"--key-file={home}/key",
                    f"--socket={home}/munge/socket", f"--seed-file={home}/munge/seed", f"--pid-file={home}/munge/pid",
                    f"--log-file={home}/log/munged.own")
        self.wait("munged", lambda: os.path.exists(f"{home}/munge/socket"))
        self.daemon("slurmctld", "-D", "-i", "-f", f"{home}/slurm.conf")
        self.wait("slurmctld", lambda: "UP" in self.said("scontrol", "ping"))
        self.daemon("slurmd", "-D", "-N", "node0", "-f", f"{home}/slurm.conf")
        self.wait("slurmd", lambda: self.said("sinfo", "-h", "-N", "-o", "%t").startswith(("idle", "mix", "alloc")))

    def daemon(self, *words):
        with open(f"{self.home}/log/{words[0]}.out", "wb") as log:
            self.daemons.append(subprocess.Popen(words, env=self.environment, stdin=subprocess.DEVNULL, stdout=log,
                                                 stderr=log, start_new_session=True))

    def said(self, *words):
        return subprocess.run(words, env=self.environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=60, check=False).stdout

    def wait(self, what, is_ready, seconds=20):
        until = time.monotonic() + seconds
        while not is_ready():
            if time.monotonic() > until or any(daemon.poll() is not None for daemon in self.daemons):
                raise NotStarted(f"{what} does not answer: {self.log(what)}")
            time.sleep(0.05)

    def log(self, what):
        words = ""
        for name in (what + ".out", what):
            path = f"{self.home}/log/{name}"
            if os.path.exists(path):
                with open(path, encoding="utf-8", errors="replace") as file:
                    words += file.read()[-1500:]
        return words

    def end(self):
        if len(self.daemons) == 3:
            for job in set(self.said("squeue", "-h", "-o", "%A").split()):
                self.said("scancel", "--signal=KILL", "--full", job)
                self.said("scancel", job)
            until = time.monotonic() + 10
            while self.said("squeue", "-h").strip() and time.monotonic() < until:
                time.sleep(0.2)
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        shutil.rmtree(self.home, ignore_errors=True)
