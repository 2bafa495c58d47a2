"""The texts under the fields of a class, read from its source.

A string that stands under a field documents it where the field is written, but Python
throws it away. It is read again here, when somebody asks, so that what editors show of
the source and what is shown at run time are one text.
"""

import ast
import inspect
import sys
from functools import cache
from itertools import pairwise


def field_texts(kind: type) -> dict[str, str]:
    """Text of each documented field of a class, on one line, inherited fields too.

    Args:
        kind: a class whose source is at hand, in a file, a wheel or a notebook.

    Returns:
        By field. A class whose source cannot be read contributes nothing.
    """
    texts: dict[str, str] = {}
    for one in reversed(kind.__mro__):
        texts.update(_own_texts(one))
    return texts


@cache
def _own_texts(kind: type) -> dict[str, str]:
    found = _statement(kind)
    texts: dict[str, str] = {}
    body = found.body if found else []
    for statement, below in pairwise(body):
        if (
            isinstance(statement, ast.AnnAssign)
            and isinstance(statement.target, ast.Name)
            and isinstance(below, ast.Expr)
            and isinstance(below.value, ast.Constant)
            and isinstance(below.value.value, str)
        ):
            texts[statement.target.id] = " ".join(below.value.value.split())
    return texts


def _statement(kind: type) -> ast.ClassDef | None:
    """The class statement, found by the class's qualified name."""
    scope: ast.AST | None = _module(kind.__module__)
    for name in kind.__qualname__.split("."):
        if name != "<locals>" and scope is not None:
            scope = _find(scope, name)
    if scope is None:
        scope = _cell(kind)
    return scope if isinstance(scope, ast.ClassDef) else None


def _find(scope: ast.AST, name: str) -> ast.AST | None:
    for node in ast.walk(scope):
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and node.name == name:
            return node
    return None


@cache
def _module(name: str) -> ast.Module | None:
    try:
        return ast.parse(inspect.getsource(sys.modules[name]))
    except (KeyError, OSError, TypeError, SyntaxError):
        return None


def _cell(kind: type) -> ast.AST | None:
    """The class statement as a notebook's cell holds it."""
    try:
        return _find(ast.parse(inspect.getsource(kind)), kind.__name__)
    except (OSError, TypeError, SyntaxError):
        return None
