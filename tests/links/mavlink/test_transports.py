"""Real sockets and lines: what carries bytes, and what comes of what can't be had."""

import os
import socket
import threading

import pytest

from free_ports import free_port
from viaspline.errors import LinkError
from viaspline.links.mavlink.addresses import LinkAddress, parse_address
from viaspline.links.mavlink.transport import open_transport


@pytest.mark.parametrize(
    "text",
    ["", "udp", "udp:", "udp:14550", "udp:host:", "udp:host:0", "udp:host:70000", "udp:host:x",
     "http://example.org:80", "serial:", "serial:/dev/x:fast", "serial:/dev/x:0", "tcp::5760",
     "udp:host:٣"],
)  # fmt: skip
def test_what_is_no_address_is_refused_with_those_that_are(text: str) -> None:
    with pytest.raises(LinkError, match="it can be udp:HOST:PORT"):
        parse_address(text)


def test_addresses_may_be_written_as_others_do() -> None:
    assert parse_address("udp://0.0.0.0:14550") == LinkAddress("udp", "0.0.0.0", 14550)
    assert parse_address(" serial:/dev/ttyUSB0:115200 ").number == 115200
    assert str(parse_address("serial:/dev/ttyUSB0")) == "serial:/dev/ttyUSB0:57600"


def test_who_listens_answers_those_who_have_spoken() -> None:
    port = free_port()
    ground = open_transport(LinkAddress("udp", "127.0.0.1", port))
    first, second = (open_transport(LinkAddress("udpout", "127.0.0.1", port)) for _ in range(2))
    ground.write(b"nobody is there yet")
    assert ground.read(0.0) == b""
    first.write(b"one")
    assert ground.read(2.0) == b"one"
    second.write(b"two")
    assert ground.read(2.0) == b"two"
    ground.write(b"hello")
    assert [first.read(2.0), second.read(2.0)] == [b"hello", b"hello"]
    for transport in (ground, first, second):
        transport.close()


def test_speaking_to_nobody_is_no_error() -> None:
    transport = open_transport(LinkAddress("udpout", "127.0.0.1", free_port()))
    for _ in range(3):
        transport.write(b"anybody?")
        assert transport.read(0.01) == b""
    transport.close()


def test_a_port_that_is_taken_is_said_to_be() -> None:
    port = free_port()
    first = open_transport(LinkAddress("udp", "127.0.0.1", port))
    with pytest.raises(LinkError, match=r"the port is taken; end what listens there"):
        open_transport(LinkAddress("udp", "127.0.0.1", port))
    first.close()


def test_nobody_can_listen_at_another_machines_address() -> None:
    with pytest.raises(LinkError, match=r"udpout:192\.0\.2\.7:14550 speaks to it"):
        open_transport(LinkAddress("udp", "192.0.2.7", 14550))


@pytest.mark.parametrize("kind", ["udp", "udpout", "tcp"])
def test_a_name_that_is_not_known_is_said_to_be(kind: str) -> None:
    with pytest.raises(LinkError, match="network"):
        open_transport(LinkAddress(kind, "no-such-host.invalid", 14550))


def test_nobody_listens_at_a_port() -> None:
    with pytest.raises(LinkError, match=r"can't be reached \(connection refused\)"):
        open_transport(LinkAddress("tcp", "127.0.0.1", free_port(socket.SOCK_STREAM)))


def test_a_stream_is_carried_both_ways_until_it_is_closed() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = int(server.getsockname()[1])

        def echo() -> None:
            peer, _ = server.accept()
            with peer:
                peer.sendall(peer.recv(100))

        answering = threading.Thread(target=echo)
        answering.start()
        transport = open_transport(LinkAddress("tcp", "127.0.0.1", port))
        transport.write(b"hello")
        assert transport.read(2.0) == b"hello"
        answering.join()
        with pytest.raises(OSError, match="closed"):
            transport.read(2.0)
        transport.close()


def test_a_device_that_is_not_there_is_said_so() -> None:
    pytest.importorskip("serial")
    with pytest.raises(LinkError, match="is it plugged in"):
        open_transport(LinkAddress("serial", "/dev/no-such-line", 57600))


def test_a_serial_line_is_carried_both_ways() -> None:
    pytest.importorskip("serial")
    pty = pytest.importorskip("pty", reason="this machine has no pseudo-terminals")
    tty = pytest.importorskip("tty")
    near, far = pty.openpty()
    tty.setraw(near)
    transport = open_transport(LinkAddress("serial", os.ttyname(far), 57600))
    assert transport.read(0.01) == b""
    os.write(near, b"\xfd\x00\x11\x13\xff")
    data = transport.read(2.0)
    while len(data) < 5:
        data += transport.read(2.0)
    assert data == b"\xfd\x00\x11\x13\xff"
    transport.write(b"\xfe\x0a\x0d")
    assert os.read(near, 10) == b"\xfe\x0a\x0d"
    transport.close()
    os.close(near)
    os.close(far)


def test_without_the_extra_it_says_which_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "serial", None)
    with pytest.raises(LinkError, match=r"pip install 'viaspline\[serial\]'"):
        open_transport(LinkAddress("serial", "/dev/ttyUSB0", 57600))
