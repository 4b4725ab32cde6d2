"""The page of every key of a mission, made of the one place where each key is declared."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from viaspline.formats.yaml_lines import flow
from viaspline.mission.fleet.file_schema import file_schema
from viaspline.mission.value import Value

INTRODUCTION = """# Every key of a mission

A mission is a YAML file. This page is made from the declarations that the reader of missions
itself uses, so it is what this version takes. `viaspline check MISSION` names every fault of a
file at once, with its line; `viaspline check --schema` prints the same as JSON Schema, for editors.

Lengths are metres, times seconds, angles degrees where the key says `_deg`; x points east, y north,
headings turn anticlockwise from x.
"""
FIRST = ("world", "robot", "route", "spline", "separation_m", "robots", "fleet")
"""The keys of a file whose classes come first; those of all others follow."""
MOST_EXAMPLES = 3
"""Of a key."""
_UNIT = re.compile(r" ?\[([a-zA-Z/²³°%]+)\](?=[.;:,]|$| )")


def mission_reference() -> str:
    """The page in Markdown."""
    schema = file_schema()
    examples = dict(_examples(Value))
    parts = [INTRODUCTION, "## A file\n", _table(schema["properties"], schema.get("required", ()))]
    seen: set[str] = set()
    roots = dict.fromkeys((*FIRST, *schema["properties"]))
    todo = [name for key in roots for name in _named(schema["properties"][key])]
    while todo:
        name = todo.pop(0)
        if name in seen:
            continue
        seen.add(name)
        part = schema["$defs"][name]
        parts += [f"\n## {name} {{ #{name.lower()} }}\n", part.get("description", "") + "\n"]
        if name in examples:
            parts += [f"Expected: {examples[name]}.\n"]
        parts += [_table(part.get("properties", {}), part.get("required", ()))]
        todo += [one for key in part.get("properties", {}).values() for one in _named(key)]
    return "\n".join(parts).rstrip() + "\n"


def _examples(kind: type) -> Iterator[tuple[str, str]]:
    for one in kind.__subclasses__():
        rules = getattr(one, "key_rules", {})
        if rules.get("expected"):
            yield one.__name__, re.sub(r"(\{.*\}|\[.*\])", r"`\1`", rules["expected"])
        yield from _examples(one)


def _named(schema: Any) -> Iterator[str]:
    """The classes that a key's schema speaks of, in order."""
    if isinstance(schema, dict):
        if "$ref" in schema:
            yield schema["$ref"].rsplit("/", 1)[-1]
        for key, value in schema.items():
            if key != "default":
                yield from _named(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from _named(value)


def _table(properties: dict[str, Any], required: Any) -> str:
    rows = ["| key | takes | unit | default | example | what it is |", "|---|---|---|---|---|---|"]
    for key, schema in properties.items():
        text = " ".join(schema.get("description", "").split()).replace("|", "\\|")
        unit = _UNIT.search(text)
        words = _UNIT.sub("", text, count=1).replace("[", "&#91;")  # no link of Markdown
        rows.append(
            f"| `{key}` | {_takes(schema)} | {unit[1] if unit else ''} "
            f"| {_default(key, schema, required)} | {_example(schema)} | {words} |"
        )
    return "\n".join(rows) + "\n"


def _example(schema: dict[str, Any]) -> str:
    """How the key is written, most often in one way; what has other forms has up to three."""
    said = [flow(one).replace("|", "\\|") for one in schema.get("examples", ())]
    return ", ".join(f"`{one}`" for one in said[:MOST_EXAMPLES])


def _default(key: str, schema: dict[str, Any], required: Any) -> str:
    if key in required:
        return "**required**"
    default = schema.get("default")
    if default is None or default in ([], {}):
        return "–"
    if isinstance(default, dict):
        return "its own"
    return f"`{json.dumps(default)}`"


def _takes(schema: dict[str, Any]) -> str:
    """In a word or two what a key takes."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[-1]
        return f"[{name}](#{name.lower()})"
    if "anyOf" in schema or "oneOf" in schema:
        several = schema.get("anyOf", schema.get("oneOf", []))
        words = [_takes(one) for one in several if one.get("type") != "null"]
        return " or ".join(dict.fromkeys(words))
    if "enum" in schema:
        return ", ".join(f"`{word}`" for word in schema["enum"])
    if "const" in schema:
        return f"`{schema['const']}`"
    kind = schema.get("type", "")
    if kind == "array":
        return _list(schema)
    if kind == "object":
        inner = schema.get("additionalProperties")
        return f"names: {_takes(inner)}" if isinstance(inner, dict) else "mapping"
    if kind in ("number", "integer"):
        return _number(schema)
    return {"string": "text", "boolean": "`true`, `false`"}.get(kind, kind)


def _list(schema: dict[str, Any]) -> str:
    if "prefixItems" in schema:
        return f"[{len(schema['prefixItems'])} numbers]"
    items = schema.get("items", {})
    if "prefixItems" in items:
        return f"list of [{len(items['prefixItems'])} numbers]"
    return f"list of {_takes(items)}" if items else "list"


def _number(schema: dict[str, Any]) -> str:
    low, high = schema.get("minimum"), schema.get("maximum")
    above, below = schema.get("exclusiveMinimum"), schema.get("exclusiveMaximum")
    word = "whole number" if schema["type"] == "integer" else "number"
    bounds = []
    if low is not None and abs(low) < 1e8:
        bounds.append(f"≥ {low:g}")
    if above is not None:
        bounds.append(f"> {above:g}")
    if high is not None and abs(high) < 1e8:
        bounds.append(f"≤ {high:g}")
    if below is not None:
        bounds.append(f"< {below:g}")
    return f"{word} {', '.join(bounds)}".strip()
