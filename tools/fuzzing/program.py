"""Runs the program under test with limits on time, memory and output."""
import dataclasses
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import time

MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
       "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
       "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_mpi_yield_when_idle": "1"}
SHOWN = 4000            # number of final characters of the output that are read
MOST_OUTPUT = 256 << 20   # bytes in one file; the limit ends the program
MOST_MEMORY = 6 << 30     # bytes of address space; unlimited for sanitizers, which take terabytes
# Ends by a limit of processor time; mpirun adds the signal to 128.
CUT = (-signal.SIGXCPU, -signal.SIGKILL, 128 + signal.SIGXCPU, 128 + signal.SIGKILL)
FRESH_HEAP, OTHER_HEAP = 0x7F, 0x01   # fresh memory then holds doubles of -3e-306 or -5e303


@dataclasses.dataclass
class Done:
    """End of a run of the program; `code` is negative for a signal, None after a timeout."""
    code: int
    output: str
    errors: str
    printed: int     # bytes on both streams
    seconds: float   # wall time
    cpu: float       # s, of the program and its children
    memory: int      # bytes, largest resident set

    @property
    def said(self):
        return self.output + self.errors


class Program:
    """`scratch` takes Open MPI's session files; those of killed runs would disturb other runs."""

    def __init__(self, path, scratch, ranks=1, cpu=60.0, nice=5):
        self.path, self.scratch = str(pathlib.Path(path).resolve()), str(scratch)
        self.ranks, self.cpu, self.nice = ranks, cpu, nice
        self.sanitized = b"__asan_init" in pathlib.Path(self.path).read_bytes()

    def command(self, arguments, ranks):
        words = [self.path, *map(str, arguments)]
        return words if ranks == 1 else ["mpirun", "--oversubscribe", "-n", str(ranks), *words]

    def prepare(self):
        os.nice(self.nice)
        os.setsid()
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (MOST_OUTPUT, MOST_OUTPUT))
        if not self.sanitized:
            resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (int(self.cpu) + 1, int(self.cpu) + 2))

    def start(self, *arguments, folder, ranks=None, heap=FRESH_HEAP, out=subprocess.DEVNULL, err=subprocess.DEVNULL):
        environment = {**os.environ, **MPI, "MALLOC_PERTURB_": str(heap), "TMPDIR": self.scratch}
        return subprocess.Popen(self.command(arguments, ranks or self.ranks), cwd=folder, env=environment,
                                stdin=subprocess.DEVNULL, stdout=out, stderr=err, preexec_fn=self.prepare)

    def run(self, *arguments, folder, ranks=None, heap=FRESH_HEAP):
        """Runs to the end; a run that takes eight times its limit of processor time in wall time is killed.

        Memory that the program has not written to holds the complement of `heap` in every byte."""
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            started = time.monotonic()
            process = self.start(*arguments, folder=folder, ranks=ranks, heap=heap, out=out, err=err)
            code, usage = wait(process, started + 8 * self.cpu)
            printed = os.fstat(out.fileno()).st_size + os.fstat(err.fileno()).st_size
            return refused_by_sanitizer(
                Done(code, tail(out), tail(err), printed, time.monotonic() - started,
                     usage.ru_utime + usage.ru_stime if usage else self.cpu,
                     usage.ru_maxrss * 1024 if usage else 0))


def refused_by_sanitizer(done):
    """The address sanitizer aborts where a damaged file asks for terabytes at once. Without it the allocation throws,
    and the program refuses the file."""
    if "AddressSanitizer: requested allocation size" in done.errors:
        done.code, done.errors = 2, "seiche: asks for more memory than the address sanitizer has"
    return done


def tail(stream):
    size = stream.seek(0, os.SEEK_END)
    stream.seek(max(0, size - SHOWN))
    return stream.read().decode(errors="replace")


def session_members(leader):
    """Processes of the session of `leader` that still run; zombies do not count."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            state, _, _, session = (entry / "stat").read_text().rpartition(")")[2].split()[:4]
        except OSError:
            continue
        if int(session) == leader and state != "Z":
            found.append(int(entry.name))
    return found


def kill_session(leader):
    """Kills all processes of a session and returns when none runs any more.

    `mpirun` puts each rank into a process group of its own. A rank that outlives it by a second still holds the lock
    of the run, so that a run started at once is refused."""
    until = time.monotonic() + 60
    while (members := session_members(leader)) and time.monotonic() < until:
        for pid in members:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(0.001)


def wait(process, until):
    """(exit code or None, usage); wait4 reports the usage of this child and its children."""
    while True:
        done, status, usage = os.wait4(process.pid, os.WNOHANG)
        if done:
            process.returncode = os.waitstatus_to_exitcode(status)
            return (None if process.returncode in CUT else process.returncode), usage
        if time.monotonic() > until:
            kill_session(process.pid)
            process.wait()
            return None, None
        time.sleep(0.005)
