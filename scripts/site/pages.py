#!/usr/bin/env python3
"""Gathers the pages of the documentation site, and checks the links of the built one.

  pages.py gather FOLDER     the pages: those of the repository as they are, and generated ones
  pages.py check SITE        every link and picture of the built pages leads somewhere

Pages of the repository keep their places, so that their links hold. Generated are the reference of the
commands, from their help texts (EIGENRING names the program), the reference of the Python package, from
its docstrings and stubs, the index of the results, and the notebooks as they were executed, if they were.
"""

import argparse
import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

import notebooks
import python_reference

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = pathlib.Path(__file__).resolve().parent
TOP = ["README.md", "ADDING_A_SCHEME.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"]


def target():
    return pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))


def linked(text):
    """Targets of the links and pictures of a page that are no addresses."""
    for link in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"```.*?```", "", text, flags=re.S)):
        if not urllib.parse.urlsplit(link).scheme and not link.startswith("#"):
            yield link


def page(folder, name):
    """Copies a page of the repository with the files that it links to."""
    place = ROOT / name
    text = place.read_text(encoding="utf-8")
    for link in set(linked(text)):
        found = (place.parent / link.split("#")[0]).resolve()
        if not found.exists():
            sys.exit(f"error: {name} links to {link}, which is not there")
        inside = found.relative_to(ROOT)
        if found.is_dir():
            # a folder has no page
            text = text.replace(f"]({link})", "]")
        elif inside.name == "README.md" and inside.parent == pathlib.Path("."):
            text = text.replace(f"]({link})", f"]({link.replace('README.md', 'index.md')})")
        elif inside.suffix != ".md":
            # the list of results is a page of its own
            if inside == pathlib.Path("results/index.toml"):
                text = text.replace(f"]({link})", f"]({link.replace('.toml', '.md')})")
            (folder / inside).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(found, folder / inside)
    written = folder / ("index.md" if name == "README.md" else name)
    written.parent.mkdir(parents=True, exist_ok=True)
    written.write_text(text, encoding="utf-8")


def commands(folder):
    """A page for each command, of its help text and those of the commands below it."""
    built = target() / "release" / "eigenring"
    program = os.environ.get("EIGENRING", str(built))
    if not os.access(program, os.X_OK):
        sys.exit("error: the command is not built: cargo build --release, or EIGENRING names it")

    def help_of(*names):
        done = subprocess.run([program, *names, "--help"], capture_output=True, text=True, timeout=60)
        if done.returncode:
            sys.exit(f"error: {' '.join(names)} --help failed: {done.stderr.strip()}")
        return done.stdout.rstrip()

    def below(text):
        """Commands that a help text lists."""
        listed = text.partition("\nCommands:\n")[2].split("\n\n")[0].splitlines()
        names = [line.split()[0] for line in listed if line.startswith("  ") and line[2:3].isalpha()]
        return [name for name in names if name != "help"]

    def section(names, depth):
        text = texts[names[0]] if len(names) == 1 else help_of(*names)
        found = [f"{'#' * depth} eigenring {' '.join(names)}".rstrip(), "", "```text", text, "```", ""]
        for name in below(text):
            found += section([*names, name], depth + 1)
        return found

    place = folder / "commands"
    place.mkdir()
    top = help_of()
    names = below(top)
    texts = {name: help_of(name) for name in names}
    lines = ["# Commands", "", "| command | |", "|---|---|"]
    # the first paragraph says what a command does
    about = {name: " ".join(text.split("\n\n")[0].split()).replace("|", "\\|") for name, text in texts.items()}
    lines += [f"| [`{name}`]({name}.md) | {about[name]} |" for name in names]
    (place / "index.md").write_text("\n".join([*lines, "", "```text", top, "```", ""]), encoding="utf-8")
    for name in names:
        (place / f"{name}.md").write_text("\n".join(section([name], 1)), encoding="utf-8")
    return ["commands/index.md"] + [{name: f"commands/{name}.md"} for name in names]


def results(folder):
    """The index of the results as a page, with the files themselves."""
    import tomllib

    index = tomllib.loads((ROOT / "results/index.toml").read_text(encoding="utf-8"))
    shutil.copytree(ROOT / "results", folder / "results", dirs_exist_ok=True)
    lines = ["# Results", "", "Every stored file, with the command that makes it and the tests that examine it.", ""]
    for entry in index["entry"]:
        lines += [f"## {entry['name']}", "", entry["shows"], "", "```text", entry["command"], "```", ""]
        lines += [f"- [{name}]({name})" for name in entry["files"] if (ROOT / "results" / name).is_file()]
        tests = ", ".join(f"`{test}`" for test in entry.get("tests", []))
        lines += ["", f"Examined by {tests}." if tests else "", ""]
    (folder / "results/index.md").write_text("\n".join(lines), encoding="utf-8")


def gather(folder):
    import yaml

    pages = folder / "pages"
    shutil.rmtree(folder, ignore_errors=True)
    pages.mkdir(parents=True)
    results(pages)
    for name in [*TOP, *(str(path.relative_to(ROOT)) for path in sorted((ROOT / "docs").glob("*.md")))]:
        page(pages, name)
    (pages / "python.md").write_text(python_reference.page(), encoding="utf-8")
    found = {"Commands": commands(pages), "Notebooks": notebooks.pages(ROOT / "notebooks", target() / "notebooks", pages)}
    settings = yaml.safe_load((SITE / "mkdocs.yml").read_text(encoding="utf-8"))

    def filled(entries):
        for entry in entries:
            for title, value in entry.items() if isinstance(entry, dict) else ():
                if isinstance(value, list):
                    entry[title] = found[title] if not value else filled(value)
        return entries

    filled(settings["nav"])
    (folder / "mkdocs.yml").write_text(yaml.safe_dump(settings, sort_keys=False), encoding="utf-8")


class Links(html.parser.HTMLParser):
    """Links of a built page, and what can be linked to in it."""

    def __init__(self, text):
        super().__init__()
        self.links, self.names = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name"):
                self.names.add(value)
            if name in ("href", "src") and value:
                self.links.append(value)


def check(site):
    pages = {path.resolve(): Links(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")}
    if not pages:
        sys.exit(f"error: no pages in {site}")
    count, broken = 0, []
    for path, found in pages.items():
        if path.name == "404.html":
            continue
        for link in found.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            count += 1
            to = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if to.is_dir():
                to = to / "index.html"
            name = urllib.parse.unquote(parts.fragment)
            if not to.exists() or (name and to in pages and name not in pages[to].names):
                broken.append(f"{path.relative_to(site.resolve())}: {link}")
    print(f"{len(pages)} pages, {count} links, {len(broken)} broken")
    for line in broken:
        print(line)
    return 1 if broken else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["gather", "check"])
    parser.add_argument("folder", type=pathlib.Path)
    given = parser.parse_args()
    return gather(given.folder) if given.what == "gather" else check(given.folder)


if __name__ == "__main__":
    sys.exit(main())
