"""The reference of the Python package: signatures from its stubs, text and examples from its docstrings."""

import ast
import inspect
import pathlib
import re


def signatures(tree, prefix=""):
    """Signatures of functions and methods by name; several of one that is overloaded."""
    found = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            found.update(signatures(node, f"{node.name}."))
        elif isinstance(node, ast.FunctionDef):
            decorators = [ast.unparse(decorator) for decorator in node.decorator_list]
            returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
            if "property" in decorators:
                text = f"{node.name}: {ast.unparse(node.returns)}"
            else:
                arguments = [part for part in ast.unparse(node.args).split(", ") if part not in ("self", "cls")]
                text = f"{node.name}({', '.join(arguments)}){returns}"
            found.setdefault(prefix + node.name, []).append(text)
    return found


def markdown(text):
    """A docstring as Markdown: its roles and literals as code, its examples as blocks."""
    text = re.sub(r":(?:class|meth|func|attr):`~?([^`]+)`", r"`\1`", text)
    text = text.replace("``", "`")
    lines, example = [], False
    for line in text.splitlines():
        if line.startswith(">>>") and not example:
            lines += ["", "```pycon"]
            example = True
        elif example and not line.strip():
            lines += ["```", ""]
            example = False
        lines.append(line)
    return "\n".join([*lines, *(["```"] if example else [])])


def page():
    """The whole reference."""
    import eigenring

    folder = pathlib.Path(eigenring.__file__).parent
    known = {}
    for name in ("_native.pyi", "_tables.py", "_sweep.py", "_error.py"):
        known.update(signatures(ast.parse((folder / name).read_text(encoding="utf-8"))))
    lines = ["# Python reference", "", markdown(inspect.getdoc(eigenring)), ""]

    def item(depth, called, key, value):
        lines.extend([f"{'#' * depth} {called}", ""])
        shown = known.get(key, [])
        if shown:
            lines.extend(["```python", *shown, "```", ""])
        lines.extend([markdown(inspect.getdoc(value) or ""), ""])

    for name in eigenring.__all__:
        value = getattr(eigenring, name)
        if name.startswith("__"):
            continue
        item(2, f"`{name}`", f"{name}.__new__" if inspect.isclass(value) else name, value)
        if inspect.isclass(value):
            for member, part in vars(value).items():
                if not member.startswith("_") and inspect.getdoc(getattr(part, "__func__", part)):
                    item(3, f"`{name}.{member}`", f"{name}.{member}", getattr(part, "__func__", part))
    return "\n".join(lines)
