"""Runs a program in a network namespace of its own that has nothing but a loopback interface. Bytes leave it through unix
sockets alone, so nothing but this test's own traffic can pass.

    other_namespace.py FOLDER COMMAND...

Standard input, one line each: `out PORT`: connections to 127.0.0.1:PORT in here are passed to FOLDER/PORT.sock;
`in PORT`: connections to FOLDER/in.PORT.sock are passed to 127.0.0.1:PORT in here; `start`: starts COMMAND.
Exits with the command's exit code; 77 when namespaces are not to be had.
"""
import asyncio
import ctypes
import fcntl
import os
import pathlib
import socket
import struct
import subprocess
import sys

CLONE_NEWNET = 0x40000000
SIOCSIFFLAGS, IFF_UP = 0x8914, 1


def leave_network():
    if ctypes.CDLL(None, use_errno=True).unshare(CLONE_NEWNET) != 0:
        sys.exit(77)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        fcntl.ioctl(any_socket, SIOCSIFFLAGS, struct.pack("16sh14x", b"lo", IFF_UP))
    # Ports chosen in here must not be taken outside, where the forwarder listens on the same numbers.
    pathlib.Path("/proc/sys/net/ipv4/ip_local_port_range").write_text("20000 20999")


async def pump(reader, writer):
    try:
        while data := await reader.read(1 << 16):
            writer.write(data)
            await writer.drain()
    except OSError:
        pass
    writer.close()


def forwarder(connect):
    """Passes an accepted connection on to what `connect` opens."""
    async def serve(reader, writer):
        try:
            there_reader, there_writer = await connect()
        except OSError:
            return writer.close()
        await asyncio.gather(pump(reader, there_writer), pump(there_reader, writer))
    return serve


async def tcp_to_unix(port, path):
    await asyncio.start_server(forwarder(lambda: asyncio.open_unix_connection(path)), "127.0.0.1", port)


async def unix_to_tcp(path, port):
    await asyncio.start_unix_server(forwarder(lambda: asyncio.open_connection("127.0.0.1", port)), path)


async def main(folder, command):
    lines = asyncio.StreamReader()
    await asyncio.get_running_loop().connect_read_pipe(lambda: asyncio.StreamReaderProtocol(lines), sys.stdin)
    program = None
    while line := (await lines.readline()).decode().split():
        if line[0] == "out":
            await tcp_to_unix(int(line[1]), f"{folder}/{line[1]}.sock")
        elif line[0] == "in":
            await unix_to_tcp(f"{folder}/in.{line[1]}.sock", int(line[1]))
        else:
            program = subprocess.Popen(command)
        print("done", flush=True)
    if program is None:
        return 2
    return await asyncio.to_thread(program.wait)


if __name__ == "__main__":
    leave_network()
    print("isolated", os.getpid(), flush=True)
    sys.exit(asyncio.run(main(sys.argv[1], sys.argv[2:])))
