#!/usr/bin/env python3
"""Runs a command with a display of its own: virtual_display.py COMMAND ...

In place of `xvfb-run -a` where several tests run at once. That script looks for a free number and then starts the
server, so two of them may take the same one; the display then ends with the other's command. It also waits for ever
where the server is ready before the script waits. Here the server chooses its number and writes it when it is ready.
Nor does it start anew when its last client leaves: ParaView opens a second window at about that time, and would find no
server then (bad X server connection)."""
import contextlib
import os
import subprocess
import sys
import tempfile


@contextlib.contextmanager
def display():
    """Number of the display of a server that runs until the end of the block."""
    ours, servers = os.pipe()
    with tempfile.TemporaryFile() as said:
        command = ["Xvfb", "-displayfd", str(servers), "-screen", "0", "1280x1024x24", "-nolisten", "tcp",
                   "-noreset"]
        with subprocess.Popen(command, pass_fds=[servers], stdout=said, stderr=said) as server:
            os.close(servers)
            with os.fdopen(ours) as pipe:
                number = pipe.readline().strip()
            try:
                if not number:
                    said.seek(0)
                    sys.exit(f"Xvfb did not start:\n{said.read().decode(errors='replace')[-1000:]}")
                yield int(number)
            finally:
                server.terminate()


def run(command):
    """Exit code of a command that has a display."""
    with display() as number:
        return subprocess.run(command, env={**os.environ, "DISPLAY": f":{number}"}, check=False).returncode


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
