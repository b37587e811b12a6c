"""The open door: no program of the build folder listens to the network, and what plain YADE opens can be shut."""
import json
import os
import re
import subprocess
import sys
import textwrap

import pytest
import shell
from shell import PREFIX
from yade.nonsmooth import servers
from yade.nonsmooth.running import processes

from contact_scenes import launch


# What a process listens on, from the kernel: local addresses of its own sockets that are in state LISTEN.
LISTENING = textwrap.dedent(
    """
    import os

    def look(pid):
        own = set()
        for name in os.listdir("/proc/%s/fd" % pid):
            try:
                own.add(os.readlink("/proc/%s/fd/%s" % (pid, name)))
            except OSError:
                pass
        found = set()
        for table in ("tcp", "tcp6"):
            for line in open("/proc/%s/net/%s" % (pid, table)).read().splitlines()[1:]:
                words = line.split()
                if words[3] == "0A" and "socket:[%s]" % words[9] in own:
                    address, port = words[1].split(":")
                    found.add((address, int(port, 16)))
        return sorted(found)

    def listening(pid="self"):
        # the kernel gives its table in pieces: where others open and shut sockets meanwhile, one may stand in it twice or not at all
        before, now = None, look(pid)
        while before != now:
            before, now = now, look(pid)
        return now
    """
)
LOOPBACK = "0100007F"  # 127.0.0.1 as /proc/net/tcp writes it


def run_program(name, *arguments, **changes):
    return shell.run(os.path.join(PREFIX, "bin", name), *arguments, limit=120, **changes)


@pytest.fixture
def script(tmp_path):
    def write(text):
        path = tmp_path / "script.py"
        path.write_text(LISTENING + textwrap.dedent(text))
        return path

    return write


def test_the_probe_sees_a_socket_that_listens():
    # else the other tests would pass by looking away
    probe = (
        LISTENING
        + "import socket\ns = socket.create_server(('', 0))\nprint(listening() == [('00000000', s.getsockname()[1])])\n"
    )
    assert (
        subprocess.run(
            [sys.executable if "python" in sys.executable else "/usr/bin/python3", "-c", probe],
            text=True,
            capture_output=True,
            timeout=60,
        ).stdout
        == "True\n"
    )


def test_a_script_of_the_launcher_listens_to_nobody(script):
    done = launch(script("print('listening', listening())"))
    assert done.returncode == 0 and "listening []" in done.stdout, done.stdout + done.stderr
    assert "cookie" not in done.stderr and "XMLRPC" not in done.stdout


def test_the_programs_of_the_build_folder_listen_to_nobody_else(script, tmp_path):
    done = run_program("yade", "-n", "-x", script("print('listening', listening())"))
    assert done.returncode == 0 and "listening []" in done.stdout, done.stdout + done.stderr
    # a job of yade-batch, and yade-batch itself, whose page stays on this machine
    job = script(
        """
        import json
        pid, chain = os.getpid(), {}
        while pid > 1:
            status = open("/proc/%d/status" % pid).read()
            chain[open("/proc/%d/cmdline" % pid).read().replace("\\0", " ")] = listening(pid)
            pid = int(status.split("PPid:")[1].split()[0])
        json.dump(chain, open("listening.json", "w"))
        """
    )
    done = subprocess.run(
        [os.path.join(PREFIX, "bin", "yade-batch"), "--job-threads=1", "-j1", job.name],
        cwd=tmp_path,
        text=True,
        capture_output=True,
        timeout=120,
    )
    assert (tmp_path / "listening.json").exists(), done.stdout + done.stderr
    chain = json.loads((tmp_path / "listening.json").read_text())
    ours = {command: ports for command, ports in chain.items() if "bin/yade" in command and "run_pytest" not in command}
    batch = [ports for command, ports in ours.items() if "yade-batch" in command and "python" in command]
    assert len(ours) >= 2 and len(batch) == 1, chain
    assert [address for ports in ours.values() for address, _ in ports] == [LOOPBACK]  # the page
    assert len(batch[0]) == 1


def test_workers_listen_to_nobody(tmp_path):
    # a function of the package that runs in a process of its own; the log holds what YADE says when it opens a server
    with pytest.raises(processes.RunError):
        processes.call(processes.call, tmp_path, {"arguments": {}})  # any call will do: it fails after YADE has started
    log = (tmp_path / "log.txt").read_text()
    assert "Running script" in log and "TCP python prompt" not in log and "XMLRPC" not in log


def test_what_plain_yade_opens_can_be_shut(script):
    """YADE's own program, without this project's: its two servers run, and one call ends them."""
    with open(os.path.join(PREFIX, "bin", "yade")) as ours:
        program = re.search(r'open\("(.*)", "rb"\)', ours.read()).group(1)
    path = script(
        f"""
        import importlib.util, socketserver
        open_before = listening()
        mine = socketserver.TCPServer(("127.0.0.1", 0), socketserver.BaseRequestHandler)
        spec = importlib.util.spec_from_file_location("servers", {servers.__file__!r})
        servers = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(servers)
        shut = servers.close()
        print("shut", shut == [port for _, port in open_before], len(shut), [address for address, _ in open_before])
        print("left", listening() == [("0100007F", mine.server_address[1])], servers.close())
        """
    )
    environment = {k: v for k, v in os.environ.items() if k not in ("OMP_NUM_THREADS", "YADE_PREFIX")}
    done = subprocess.run(
        [program, "-n", "-x", str(path)], env=environment, text=True, capture_output=True, timeout=120
    )
    assert "shut True 2 ['00000000', '00000000']" in done.stdout, done.stdout + done.stderr
    assert "left True []" in done.stdout, done.stdout
