# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Options from the command line and from a file (TOML), checked by one parser."""
from __future__ import annotations

import argparse
import contextlib
import importlib
import os
import sys
from collections.abc import Iterable, Sequence
from typing import Any, NoReturn

import numpy

from .files import ReadingError

# Options that a file cannot have.
_LINE_ONLY = ("help", "config", "version")


class OptionParser(argparse.ArgumentParser):
    """A parser whose options may also stand in a file, as keys of the same names. --no-NAME on the
    command line leaves out the file's option NAME.

    An option needs the name --config for the file's name, and a positional argument "mesh" with
    nargs="*".
    """

    def __init__(self, **arguments: Any) -> None:
        self._names: dict[str, argparse.Action] = {}
        self._file = ""  # whose options are parsed
        self._group: argparse._ArgumentGroup | None = None
        super().__init__(**arguments)

    def start_group(self, title: str) -> None:
        """The help lists the next options under a title."""
        self._group = self.add_argument_group(title)

    def add_argument(self, *names: Any, offers: Iterable[str] = (), **settings: Any
                     ) -> argparse.Action:
        """offers: values that complete() proposes; others are allowed."""
        action = (self._group or super()).add_argument(*names, **settings)
        if offers:
            setattr(action, "completer", lambda **_: list(offers))  # as argcomplete expects it
        for name in names:
            if name.startswith("--"):
                self._names[name[2:]] = action
                if name[2:] not in _LINE_ONLY:
                    super().add_argument("--no-" + name[2:], dest="left_out", const=action.dest,
                                         action="append_const", help=argparse.SUPPRESS)
        return action

    def error(self, message: str) -> NoReturn:
        if self._file:
            raise ReadingError(f"{self._file}: {message}")
        super().error(message)

    def complete(self) -> None:
        """Answers a shell that asks for the words that may follow, by the package argcomplete, and
        ends the program; does nothing otherwise."""
        if "_ARGCOMPLETE" not in os.environ:
            return
        with contextlib.suppress(ImportError):
            importlib.import_module("argcomplete").autocomplete(self)

    def parse(self, arguments: Sequence[str] | None = None) -> argparse.Namespace:
        """Options of the command line and, where it has none, of the file that it names. A file
        with an error is a ReadingError."""
        arguments = self._put_mesh_first(sys.argv[1:] if arguments is None else arguments)
        options = self.parse_args(arguments)
        if options.config:
            self._take_defaults(options.config, options.left_out or ())
            options = self.parse_args(arguments)
        if not options.mesh:
            options.mesh = self.get_default("mesh")
        if not options.mesh:
            takers = [word for word in arguments if self._takes_any_number(word)]
            self.error("no mesh is named: meniscus MESH, or meniscus demo" + (
                f"; it goes before {takers[-1]}, which takes any number of values" if takers else ""
            ))
        return options

    def _takes_any_number(self, word: str) -> bool:
        """Whether a word is the name of an option with any number of values."""
        return word.startswith("--") and word[2:] in self._names and (
            self._names[word[2:]].nargs == "+")

    def _put_mesh_first(self, words: Sequence[str]) -> list[str]:
        """Words of a command line whose files are first where they follow an option with any number
        of numbers, to which argparse would give them. Numbers are as argparse takes them."""
        files: list[str] = []
        others: list[str] = []
        target, has_numbers = files, False
        for place, word in enumerate(words):
            if has_numbers and words[place - 1].startswith("--") and not _is_number(word):
                self.error(f"argument {words[place - 1]}: '{word}' is not a number")
            if word == "--":
                return [*files, *others, *words[place:]]
            if word.startswith("-") and not _is_number(word):
                has_numbers = (self._takes_any_number(word)
                               and self._names[word[2:]].type is float)
                target = others
            elif has_numbers and not _is_number(word):
                target = files
            target.append(_text_of(float(word)) if _has_exponent(word) else word)
        return [*files, *others]

    def _take_defaults(self, name: str, left_out: Sequence[str]) -> None:
        """left_out: destinations of options that do not count."""
        values = read_toml(name)
        mesh = values.pop("mesh", None)
        if isinstance(mesh, str):
            mesh = [mesh]
        if mesh is not None and not (isinstance(mesh, list)
                                     and all(isinstance(file, str) for file in mesh)):
            raise ReadingError(f"{name}: mesh must be the name of a file, or a list of names")
        known = [key for key in self._names if key not in _LINE_ONLY]
        for key, value in values.items():
            if key not in known:
                raise ReadingError(f"{name}: there is no option '{key}'; known are "
                                   + ", ".join(["mesh", *known]))
            if self._names[key].dest not in left_out:
                self._take_default(name, key, value)
        self.set_defaults(mesh=mesh)

    def _take_default(self, name: str, key: str, value: Any) -> None:
        self._file = name
        found = self.parse_args(self._words_of(name, key, value))
        self._file = ""
        if found.mesh:  # values that no option takes
            raise ReadingError(f"{name}: {key} has too many values")
        destination = self._names[key].dest
        self.set_defaults(**{destination: getattr(found, destination)})

    def _words_of(self, name: str, key: str, value: Any) -> list[str]:
        """An option as words of a command line. A value that could be another option is joined
        with the name of this one, or refused."""
        if self._names[key].nargs == 0:
            if not isinstance(value, bool):
                raise ReadingError(f"{name}: {key} must be true or false")
            return ["--" + key] if value else []
        items = value if isinstance(value, list) else [value]
        for item in items:
            if isinstance(item, bool) or not isinstance(item, (int, float, str)):
                raise ReadingError(f"{name}: {key} must be a number or text"
                                   + (", or a list of them" if self._names[key].nargs else ""))
            if isinstance(item, str) and item.startswith("-") and isinstance(value, list):
                raise ReadingError(f"{name}: {key} must not begin with '-': '{item}'")
        texts = [item if isinstance(item, str) else _text_of(item) for item in items]
        if not isinstance(value, list):
            return [f"--{key}={texts[0]}"]
        return ["--" + key, *texts]


def _has_exponent(text: str) -> bool:
    return text.startswith("-") and "e" in text.lower() and _is_number(text)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _text_of(number: float) -> str:
    """A number as argparse takes it, which reads -1e-05 as the name of an option."""
    if isinstance(number, int) or not numpy.isfinite(number):
        return str(number)
    return str(numpy.format_float_positional(number, trim="-"))


def read_toml(name: str) -> dict[str, Any]:
    """The keys and values of a file. TOML is data: nothing in it is run."""
    try:
        with open(name, "rb") as file:
            text = file.read()
    except FileNotFoundError:
        raise ReadingError(f"{name}: there is no such file") from None
    except OSError as error:
        raise ReadingError(f"{name}: {error.strerror}") from None
    for module in ("tomllib", "tomli"):  # of Python 3.11; a package
        try:
            toml = importlib.import_module(module)
            break
        except ImportError:
            continue
    else:
        raise ReadingError("--config needs Python 3.11, or the package tomli: pip install tomli")
    try:
        values: dict[str, Any] = toml.loads(text.decode())
    except ValueError as error:  # of the syntax, or of UTF-8
        raise ReadingError(f"{name}: {error}") from None
    return values
