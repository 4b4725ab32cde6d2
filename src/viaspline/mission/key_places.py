"""Which keys a mission has, and what may stand at each: read from the fields of its models."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from types import NoneType, UnionType
from typing import Annotated, Any, NamedTuple, TypeAlias, Union, cast, get_args, get_origin

from pydantic import BeforeValidator
from pydantic.fields import FieldInfo
from pydantic.json_schema import SkipJsonSchema
from pydantic_core import PydanticUndefined

from viaspline.mission.unplaced_faults import Path
from viaspline.mission.value import Value

Model: TypeAlias = type[Value]


class Option(NamedTuple):
    """One of the things that may stand at a place.

    Attributes:
        kind: Its type, bare: a model, ``tuple[float, ...]``, ``Literal["left", "right"]``.
        said: What its annotation says beside that, from the inside out.
        is_read: Whether it stands in files only, and is made another option when it is read.
    """

    kind: Any
    said: tuple[Any, ...] = ()
    is_read: bool = False

    @property
    def model(self) -> Model | None:
        """The model, if it is a mapping."""
        is_model = isinstance(self.kind, type) and issubclass(self.kind, Value)
        return cast(Model, self.kind) if is_model else None


def options(annotation: Any, said: tuple[Any, ...] = ()) -> tuple[Option, ...]:
    """What an annotation allows, None left out.

    >>> from viaspline.mission.annotations import Expects
    >>> options(Annotated[int | tuple[int, ...], Expects("one or many")] | None)[1].kind
    tuple[int, ...]
    """
    if get_origin(annotation) is Annotated:
        inner, *outer = get_args(annotation)
        return options(inner, (*_flat(outer), *said))
    if get_origin(annotation) in (Union, UnionType):
        members = [member for member in get_args(annotation) if member is not NoneType]
        return tuple(option for member in members for option in options(member, said))
    found = [Option(annotation, said)]
    for item in said:
        given = getattr(item, "json_schema_input_type", PydanticUndefined)
        if isinstance(item, BeforeValidator) and given is not PydanticUndefined:
            forms = options(given)
            found += [form._replace(is_read=True) for form in forms if form.kind is not annotation]
    return tuple(found)


def _flat(said: list[Any]) -> Iterator[Any]:
    """Metadata of an annotation, that of nested fields with it."""
    for item in said:
        if isinstance(item, FieldInfo):
            yield from item.metadata
        else:
            yield item


def key_name(name: str, field: FieldInfo) -> str:
    """What a field is called in a file."""
    return field.alias or name


def keys_of(model: Model) -> dict[str, FieldInfo]:
    """The fields of a model by their keys; those that no file has are left out."""
    hidden = cast(type, SkipJsonSchema)
    return {
        key_name(name, field): field
        for name, field in model.model_fields.items()
        if not any(isinstance(item, hidden) for item in field.metadata)
    }


def options_at(path: Path, root: Model) -> tuple[Option, ...]:
    """What may stand at a path, by the models on the way there; nothing if no key is there.

    >>> from viaspline.mission.sensor_spec import Sensor
    >>> [option.kind.__name__ for option in options_at(("lidar",), Sensor)]
    ['Lidar']
    """
    found: tuple[Option, ...] = (Option(root),)
    for part in path:
        found = tuple(step for option in found for step in _inside(option, part))
    return found


def _inside(option: Option, part: str | int) -> tuple[Option, ...]:
    """What may stand under a key of a mapping, or at an index of a list."""
    found: tuple[Option, ...] = ()
    if option.model is not None and isinstance(part, str):
        field = keys_of(option.model).get(part)
        found = () if field is None else options(field.annotation, tuple(field.metadata))
    elif get_origin(option.kind) is tuple and isinstance(part, int):
        items = get_args(option.kind)
        index = 0 if items[-1] is Ellipsis else part
        found = options(items[index]) if index < len(items) else ()
    elif get_origin(option.kind) is dict and isinstance(part, str):
        found = options(get_args(option.kind)[1])
    # What stands in a form of files only, does so itself.
    return tuple(each._replace(is_read=each.is_read or option.is_read) for each in found)


def path_of_error(loc: tuple[int | str, ...], root: Model) -> Path:
    """Pydantic's location of an error without the names of a union's branches, which are no keys.

    >>> from viaspline.mission.spline_spec import SplineSpec
    >>> path_of_error(("tension", "function-before[plain(), tuple[float, ...]]", 1), SplineSpec)
    ('tension', 1)
    """
    path: Path = ()
    here: tuple[Option, ...] = (Option(root),)
    for part in loc:
        if isinstance(part, str) and is_union(here):
            here = tuple(option._replace(is_read=True) for option in here)  # its branch is named
            continue
        path = (*path, part)
        here = tuple(step for option in here for step in _inside(option, part))
    return path


def is_union(found: tuple[Option, ...]) -> bool:
    """Whether pydantic has to try several types, each of which gives its own errors."""
    return sum(not option.is_read for option in found) > 1


def models_below(root: Model) -> Iterator[tuple[str, Model]]:
    """Every model of a mission with the key under which it stands, those near the root first."""
    seen = {root}
    queue: deque[tuple[str, Model]] = deque([("", root)])
    while queue:
        home, model = queue.popleft()
        yield home, model
        for key, field in keys_of(model).items():
            found = list(options(field.annotation, tuple(field.metadata)))
            while found:
                option = found.pop(0)
                if get_origin(option.kind) in (tuple, dict):
                    found += [inner for item in get_args(option.kind) for inner in options(item)]
                elif option.model is not None and option.model not in seen:
                    seen.add(option.model)
                    queue.append((key, option.model))
