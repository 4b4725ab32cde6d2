"""Bytes and type names against Fast DDS, an independent peer: where its generator is installed."""

import random
import shutil
import struct
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from viaspline.links.ros.ros_topics import dds_type
from viaspline.ros_messages.message_book import standard_book
from viaspline.ros_messages.message_definitions import DEFINITIONS
from viaspline.ros_messages.message_types import MessageType, needed_by, parse_definition

KINDS = [
    "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped", "nav_msgs/msg/Odometry",
    "nav_msgs/msg/Path", "nav_msgs/msg/OccupancyGrid", "sensor_msgs/msg/LaserScan",
    "tf2_msgs/msg/TFMessage", "diagnostic_msgs/msg/DiagnosticArray",
]  # fmt: skip
IDL = {
    "bool": "boolean", "byte": "octet", "uint8": "octet", "int8": "int8", "int32": "long",
    "uint32": "unsigned long", "float32": "float", "float64": "double", "string": "string",
}  # fmt: skip
TYPES: dict[str, MessageType] = {
    one: kind
    for name in DEFINITIONS
    for one, kind in parse_definition(name, DEFINITIONS[name]).items()
}
BOOK = standard_book()
MAIN = """
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>
#include "wirePubSubTypes.h"
using eprosima::fastrtps::rtps::SerializedPayload_t;
template <typename P, typename T> int again(P type, T value, std::vector<char>& bytes) {
  printf("%s\\n", type.getName());
  SerializedPayload_t in(bytes.size() + 16), out(bytes.size() + 1024);
  memcpy(in.data, bytes.data(), bytes.size());
  in.length = bytes.size();
  if (!type.deserialize(&in, &value) || !type.serialize(&value, &out)) return 3;
  for (unsigned i = 0; i < out.length; ++i) printf("%02x", out.data[i]);
  printf("\\n");
  return 0;
}
int main(int, char** argv) {
  std::string name = argv[1];
  std::vector<char> bytes;
  for (int c; (c = getchar()) != EOF;) bytes.push_back(char(c));
CASES
  return 2;
}
"""


def idl(kinds: list[str]) -> str:
    """These types as IDL, each after those that it needs."""
    ordered: list[str] = []

    def add(name: str) -> None:
        for needed in needed_by(name, TYPES):
            if needed not in ordered and needed != name:
                add(needed)
        if name not in ordered:
            ordered.append(name)

    for kind in kinds:
        add(kind)
    lines = []
    for name in ordered:
        package, _, short = name.split("/")
        fields = []
        for field in TYPES[name].fields:
            base = IDL.get(field.base) or field.base.replace("/", "::")
            size = f"[{field.size}]" if field.many == "array" else ""
            base = f"sequence<{base}>" if field.many == "sequence" else base
            fields.append(
                f"{base} f_{field.name}{size};"
            )  # names of types are taken, however spelt
        body = " ".join(fields)
        lines.append(f"module {package} {{ module msg {{ struct {short} {{ {body} }}; }}; }};")
    return "\n".join(lines)


@pytest.fixture(scope="module")
def peer(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A program of Fast DDS that reads a message and writes it again."""
    if shutil.which("fastddsgen") is None or shutil.which("g++") is None:
        pytest.skip("fastddsgen or g++ is not installed: apt-get install fastddsgen "
                    "libfastrtps-dev g++")  # fmt: skip
    folder = tmp_path_factory.mktemp("fastdds")
    (folder / "wire.idl").write_text(idl(KINDS))
    cases = "\n".join(
        f'  if (name == "{kind}") return again({kind.replace("/", "::")}PubSubType(), '
        f"{kind.replace('/', '::')}(), bytes);"
        for kind in KINDS
    )
    (folder / "main.cxx").write_text(MAIN.replace("CASES", cases))
    subprocess.run(
        ["fastddsgen", "-typeros2", "-replace", "wire.idl"], cwd=folder, check=True,
        capture_output=True,
    )  # fmt: skip
    sources = [one.name for one in folder.glob("*.cxx")]
    subprocess.run(
        ["g++", "-O0", "-w", "-o", "peer", *sources, "-lfastrtps", "-lfastcdr"],
        cwd=folder, check=True, capture_output=True,
    )  # fmt: skip
    return folder / "peer"


def made(name: str, rng: random.Random) -> dict[str, Any]:
    """A message of a type with anything in it."""

    def one(base: str) -> Any:
        if base == "string":
            return "".join(rng.choices("abc/é", k=rng.randrange(7)))
        if base == "bool":
            return rng.random() < 0.5
        if base == "float32":
            return struct.unpack("<f", struct.pack("<f", rng.uniform(-9, 9)))[0]
        if base == "float64":
            return rng.uniform(-9, 9)
        return made(base, rng) if "/" in base else rng.randrange(100)

    return {
        field.name: one(field.base)
        if field.many == "one"
        else [one(field.base) for _ in range(field.size or rng.randrange(4))]
        for field in TYPES[name].fields
    }


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_fast_dds_reads_our_bytes_and_writes_the_same(kind: str, peer: Path) -> None:
    for seed in range(5):
        data = BOOK.encoded(kind, made(kind, random.Random(seed)))
        done = subprocess.run([peer, kind], input=data, capture_output=True, check=True)
        name, written = done.stdout.decode().split()
        assert name == dds_type(kind)
        theirs = bytes.fromhex(written)
        assert theirs[: len(data)] == data
        assert not np.any(np.frombuffer(theirs[len(data) :], np.uint8))  # padding to four bytes
