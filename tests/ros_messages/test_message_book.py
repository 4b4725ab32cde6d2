"""Definitions, bytes and hashes of messages, against rosbags as the independent peer."""

import struct
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from viaspline.errors import MessageError
from viaspline.ros_messages.message_book import MessageBook, standard_book
from viaspline.ros_messages.message_definitions import DEFINITIONS
from viaspline.ros_messages.message_types import PRIMITIVES, parse_definition

PEERS = {
    store: get_typestore(store) for store in (Stores.ROS2_HUMBLE, Stores.ROS2_JAZZY, Stores.LATEST)
}
PEER = PEERS[Stores.ROS2_JAZZY]
BOOK = standard_book()
WORDS = st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=9)
RANGES = {"b": 8, "B": 8, "h": 16, "H": 16, "i": 32, "I": 32, "q": 64, "Q": 64}


def values(base: str) -> st.SearchStrategy[Any]:
    """Values of one item of a type."""
    if base == "string":
        return WORDS
    if base == "bool":
        return st.booleans()
    if base in ("float32", "float64"):
        return st.floats(width=32 if base == "float32" else 64)
    if base == "byte":
        return st.integers(0, 127)  # rosbags takes it for one with a sign
    if base in PRIMITIVES:
        letter = PRIMITIVES[base]
        bits = RANGES[letter]
        return st.integers(
            *((0, 2**bits - 1) if letter.isupper() else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1))
        )
    return messages(base)


def messages(name: str) -> st.SearchStrategy[dict[str, Any]]:
    """Messages of a type."""
    fields = {}
    for field in parse_definition(name, DEFINITIONS[name])[name].fields:
        one = values(field.base)
        size = field.size if field.many == "array" else None
        fields[field.name] = (
            one if field.many == "one" else st.lists(one, min_size=size or 0, max_size=size or 3)
        )
    return st.fixed_dictionaries(fields)


def as_peer(name: str, message: dict[str, Any]) -> Any:
    """The message as an object of rosbags."""
    made = {}
    for field in parse_definition(name, DEFINITIONS[name])[name].fields:
        value = message[field.name]
        if "/" in field.base:
            value = (
                as_peer(field.base, value)
                if field.many == "one"
                else [as_peer(field.base, v) for v in value]
            )
        elif field.many != "one":
            value = np.array(value, "<" + PRIMITIVES[field.base])
        made[field.name] = value
    return PEER.types[name](**made)


@pytest.mark.parametrize("name", DEFINITIONS)
@pytest.mark.parametrize("store", [Stores.ROS2_JAZZY, Stores.LATEST])
def test_a_type_has_the_hash_that_ros_gives_it(name: str, store: Stores) -> None:
    assert BOOK.hash(name) == PEERS[store].hash_rihs01(name)


@pytest.mark.parametrize("name", DEFINITIONS)
def test_a_type_has_the_fields_that_it_has_in_humble(name: str) -> None:
    def fields(text: str) -> Any:
        return get_types_from_msg(text, name)[name][1]

    assert fields(DEFINITIONS[name]) == fields(
        PEERS[Stores.ROS2_HUMBLE].generate_msgdef(name, ros_version=2)[0].split("=" * 80)[0]
    )


@given(st.data())
@settings(max_examples=150, deadline=None)
def test_a_message_has_the_bytes_that_rosbags_gives_it(data: st.DataObject) -> None:
    name = data.draw(st.sampled_from(list(DEFINITIONS)))
    message = data.draw(messages(name))
    encoded = BOOK.encoded(name, message)
    assert encoded == bytes(PEER.serialize_cdr(as_peer(name, message), name))
    again = BOOK.decoded(name, encoded)
    assert BOOK.encoded(name, again) == encoded


@given(st.data())
@settings(max_examples=50, deadline=None)
def test_messages_of_either_order_of_bytes_are_read(data: st.DataObject) -> None:
    name = data.draw(st.sampled_from(list(DEFINITIONS)))
    message = data.draw(messages(name))
    other = bytes(PEER.serialize_cdr(as_peer(name, message), name, little_endian=False))
    assert BOOK.encoded(name, BOOK.decoded(name, other)) == BOOK.encoded(name, message)


@given(st.binary(max_size=200), st.sampled_from(list(DEFINITIONS)))
@settings(max_examples=200, deadline=None)
def test_bytes_of_anything_give_a_message_or_a_refusal(data: bytes, name: str) -> None:
    for header in (b"", b"\0\1\0\0", b"\0\0\0\0"):
        with suppress(MessageError):
            BOOK.decoded(name, header + data)


def test_a_schema_is_read_back_by_rosbags_as_the_same_types() -> None:
    for name in DEFINITIONS:
        types = get_types_from_msg(BOOK.schema(name), name)
        assert all(PEER.fielddefs[one][1] == types[one][1] for one in types)
        assert MessageBook({name: BOOK.schema(name)}).hash(name) == BOOK.hash(name)


@pytest.mark.parametrize(
    ("text", "value", "words"),
    [
        ("float64[3] a", {"a": [1.0]}, "has 1 items, not 3"),
        ("float64[<=2] a", {"a": [1.0, 2.0, 3.0]}, "has 3 items, not 2"),
        ("string<=3 a", {"a": "four"}, "more than 3 bytes"),
        ("uint8 a", {"a": 256}, "makes no demo/msg/X"),
        ("uint8 a", {"a": "one"}, "makes no demo/msg/X"),
        ("uint8 a", {"b": 1}, "needs the field 'a'"),
        ("uint8 a\nuint8 b", {"a": 1}, "needs the field 'b'"),
        ("string a", {"a": 5}, "makes no demo/msg/X"),
        ("wstring a", {"a": "x"}, "wstring"),
        ("other/Y a", {"a": {}}, "other/msg/Y isn't defined"),
        ("what is this", {}, "no field"),
    ],
)  # fmt: skip
def test_what_does_not_fit_its_type_is_refused_by_name(text: str, value: Any, words: str) -> None:
    if words == "no field":
        text = "9 lives"
    with pytest.raises(MessageError, match=words):
        MessageBook({"demo/msg/X": text}).encoded("demo/msg/X", value)


def test_defaults_constants_comments_and_empty_messages_are_read() -> None:
    text = 'int32 A=3\nstring B="x # y"\n# words\nint32 a 5 # five\nstring<=4[<=2] names\n\n'
    (kind,) = parse_definition("demo/msg/X", text).values()
    assert [(f.name, f.base, f.many, f.size, f.text_size) for f in kind.fields] == [
        ("a", "int32", "one", 0, 0), ("names", "string", "sequence", 2, 4)]  # fmt: skip
    empty = MessageBook({"std_msgs/msg/Empty": ""})
    assert empty.hash("std_msgs/msg/Empty") == PEER.hash_rihs01("std_msgs/msg/Empty")


def test_a_long_sequence_that_is_not_there_takes_no_memory() -> None:
    data = b"\0\1\0\0" + struct.pack("<I", 2**31)
    with pytest.raises(MessageError, match="hold no"):
        BOOK.decoded("tf2_msgs/msg/TFMessage", data)
