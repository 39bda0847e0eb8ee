"""Notebooks as pages: text, code and, where they were executed, what they print and draw."""

import base64
import html
import json
import re


def formulas(text):
    """TeX as MathML, which browsers draw themselves."""
    from latex2mathml.converter import convert

    text = re.sub(r"\$\$(.+?)\$\$", lambda found: convert(found[1].strip(), display="block"), text, flags=re.S)
    return re.sub(r"\$([^$\n]+)\$", lambda found: convert(found[1]), text)


def shown(output, name):
    """Markdown of an output, and its pictures by file name."""
    if output["output_type"] == "stream":
        return ["```text", "".join(output["text"]).rstrip(), "```", ""], {}
    data = output.get("data", {})
    if "image/png" in data:
        return [f"![]({name}.png)", ""], {f"{name}.png": base64.b64decode("".join(data["image/png"]))}
    if "text/html" in data and "<table" in "".join(data["text/html"]):
        table = re.sub(r"<style.*?</style>", "", "".join(data["text/html"]), flags=re.S)
        # lines without indentation or gaps: one block of HTML
        return ["\n".join(line.strip() for line in table.splitlines() if line.strip()), ""], {}
    text = "".join(data.get("text/plain", ""))
    if "widget-view" in " ".join(data) or not text:
        return [], {}
    return ["```text", html.unescape(text).rstrip(), "```", ""], {}


def pages(sources, executed, folder):
    """Writes a page for each notebook; the entries of the navigation."""
    place = folder / "notebooks"
    place.mkdir()
    found = []
    for source in sorted(sources.glob("*.ipynb")):
        run = executed / source.name
        notebook = json.loads((run if run.exists() else source).read_text(encoding="utf-8"))
        lines, title = [], source.stem
        for number, cell in enumerate(notebook["cells"]):
            text = "".join(cell["source"])
            if cell["cell_type"] == "markdown":
                if text.startswith("# "):
                    title = text.splitlines()[0][2:]
                lines += [formulas(text), ""]
                continue
            lines += ["```python", text, "```", ""]
            for k, output in enumerate(cell.get("outputs", [])):
                more, pictures = shown(output, f"{source.stem}-{number}-{k}")
                lines += more
                for name, picture in pictures.items():
                    (place / name).write_bytes(picture)
        (place / f"{source.stem}.md").write_text("\n".join(lines), encoding="utf-8")
        found.append({title: f"notebooks/{source.stem}.md"})
    return found
