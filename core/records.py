"""`dataclass` for classes with slots, at a tenth of its price: no method is compiled before it is needed.

The standard decorator writes and compiles up to six functions for every class while its module is imported, a
millisecond each time, a fifth of the time until the first screen stands.  Here all classes share their equality, hash
and representation, and `__init__` is compiled where there are more than `FEW` instances.  Fields are the standard
library's own: `dataclasses.replace`, `fields` and the type checker see nothing else than before.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import MISSING, FrozenInstanceError, field
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final, NoReturn, TypeVar

__all__ = ["dataclass", "field"]

FEW: Final = 8
"""So many instances are made without a compiled `__init__`: most of what the first screen needs is there once."""

Made = TypeVar("Made")


def slotted(*, slots: bool, frozen: bool = False, eq: bool = True) -> Callable[[type[Made]], type[Made]]:
    """What `dataclasses.dataclass` does with these arguments.

    TypeError for what is not done here: a class without slots, with a `__post_init__`, or with
    fields that have other options than a default and `compare`.
    """

    def decorated(bare: type[Made]) -> type[Made]:
        cls: type[Made] = dataclasses.dataclass(init=False, repr=False, eq=False, slots=True)(bare)
        optioned = any(map(_optioned, dataclasses.fields(cls)))  # type: ignore[arg-type]  # a dataclass by now
        if not slots or optioned or hasattr(bare, "__post_init__"):
            message = f"{bare.__name__} needs the standard library's own dataclass"
            raise TypeError(message)
        for name, method in _methods(cls, frozen=frozen, eq=eq).items():
            # a class with an __eq__ of its own has a __hash__ of None, which is not its own
            if bare.__dict__.get(name) is None:
                setattr(cls, name, method)
        return cls

    return decorated


def _optioned(one: dataclasses.Field[Any]) -> bool:
    return not (one.init and one.repr) or one.hash is not None or one.kw_only is True


def _methods(cls: type, *, frozen: bool, eq: bool) -> dict[str, Any]:
    methods: dict[str, Any] = {"__init__": _compiling(cls), "__repr__": _representation}
    if frozen:
        methods |= {"__setattr__": _refuse, "__delattr__": _refuse}
        methods |= {"__getstate__": _state, "__setstate__": _restored}
    if eq:
        values = _values(tuple(one.name for one in dataclasses.fields(cls) if one.compare))
        methods |= {"__eq__": _equality(values), "__hash__": _hash(values) if frozen else None}
    return methods


def _compiling(cls: type) -> Callable[..., None]:
    """An `__init__` for the first `FEW` instances, which then puts the compiled one in its own place."""
    made = 0

    def first(self: object, *values: object, **named: object) -> None:
        nonlocal made
        made += 1
        if made <= FEW and _put(self, cls, values, named):
            return
        init = _compiled(cls)
        type.__setattr__(cls, "__init__", init)
        init(self, *values, **named)

    return first


def _put(self: object, cls: type, values: tuple[object, ...], named: dict[str, object]) -> bool:
    """Give an instance its values one by one; nothing done where the compiled `__init__` has to complain."""
    fields = dataclasses.fields(cls)
    given = dict(zip((one.name for one in fields), values, strict=False)) | named
    whole = (one.name in given or one.default is not MISSING or one.default_factory is not MISSING for one in fields)
    if len(given) < len(values) + len(named) or not {one.name for one in fields} >= given.keys() or not all(whole):
        return False
    for one in fields:
        value = given.get(one.name, MISSING)
        if value is MISSING:
            value = one.default if one.default_factory is MISSING else one.default_factory()
        object.__setattr__(self, one.name, value)
    return True


def _compiled(cls: type) -> Callable[..., None]:
    """The `__init__` as one would write it; a frozen instance takes its values from the slots' own setters."""
    space: dict[str, Any] = {}
    head, body = ["self"], []
    for one in dataclasses.fields(cls):
        name, value = one.name, one.name
        space[f"put_{name}"] = getattr(cls, name).__set__
        if one.default_factory is not MISSING:
            space |= {f"make_{name}": one.default_factory, "MISSING": MISSING}
            value = f"make_{name}() if {name} is MISSING else {name}"
            name = f"{name}=MISSING"
        elif one.default is not MISSING:
            space[f"default_{name}"] = one.default
            name = f"{name}=default_{name}"
        head.append(name)
        body.append(f"  put_{one.name}(self, {value})")
    exec(f"def __init__({', '.join(head)}):\n" + "\n".join(body or ["  pass"]), space)
    made: Callable[..., None] = space["__init__"]
    made.__qualname__ = f"{cls.__qualname__}.__init__"
    return made


def _values(names: tuple[str, ...]) -> Callable[[object], tuple[object, ...]]:
    """What takes all values of an instance as a tuple."""
    if not names:
        return lambda _: ()
    # a single name twice: attrgetter makes a tuple of two or more only
    return attrgetter(*names, *(names if len(names) == 1 else ()))


def _equality(values: Callable[[object], tuple[object, ...]]) -> Callable[[object, object], bool]:
    def equal(self: object, other: object) -> bool:
        return values(self) == values(other) if other.__class__ is self.__class__ else NotImplemented

    return equal


def _hash(values: Callable[[object], tuple[object, ...]]) -> Callable[[object], int]:
    return lambda self: hash(values(self))


def _representation(self: object) -> str:
    names: tuple[str, ...] = type(self).__match_args__  # type: ignore[attr-defined]
    shown = (f"{name}={getattr(self, name)!r}" for name in names)
    return f"{type(self).__qualname__}({', '.join(shown)})"


def _refuse(self: object, name: str, *_: object) -> NoReturn:
    message = f"{type(self).__name__} is frozen: {name} stays as it is"
    raise FrozenInstanceError(message)


def _state(self: object) -> list[object]:
    """What is pickled: the values in the order of the fields."""
    return [getattr(self, one.name) for one in dataclasses.fields(self)]  # type: ignore[arg-type]


def _restored(self: object, state: list[object]) -> None:
    for one, value in zip(dataclasses.fields(self), state, strict=True):  # type: ignore[arg-type]
        object.__setattr__(self, one.name, value)


if TYPE_CHECKING:
    from dataclasses import dataclass as dataclass
else:
    dataclass = slotted
