"""Where Meshcat listens."""

import ipaddress
import sys
from pathlib import Path

import pytest

from footfall.diagrams.figures.live_view import meshcat_at


def listening(port: int) -> set[ipaddress.IPv4Address | ipaddress.IPv6Address]:
    """The addresses at which this machine listens on a port, as the kernel has them."""
    found = set()
    for table in ("tcp", "tcp6"):
        for line in Path("/proc/net", table).read_text().splitlines()[1:]:
            _, local, _, state, *_ = line.split()
            address, _, hex_port = local.partition(":")
            if state == "0A" and int(hex_port, 16) == port:
                words = [address[i : i + 8] for i in range(0, len(address), 8)]
                packed = b"".join(
                    int(word, 16).to_bytes(4, sys.byteorder) for word in words
                )
                found.add(ipaddress.ip_address(packed))
    return found


@pytest.mark.skipif(sys.platform != "linux", reason="looks in /proc/net")
def test_listens_on_this_machine_alone_unless_asked() -> None:
    """Nobody else in the network sees what the robot does."""
    own = meshcat_at()
    assert listening(own.port()) == {ipaddress.ip_address("127.0.0.1")}
    assert own.web_url() == f"http://127.0.0.1:{own.port()}"
    everyones = meshcat_at("*")
    assert any(address.is_unspecified for address in listening(everyones.port()))


def test_an_interface_that_is_not_there_is_an_error() -> None:
    """192.0.2.0/24 is kept free for documentation."""
    with pytest.raises(RuntimeError):
        meshcat_at("192.0.2.1")
