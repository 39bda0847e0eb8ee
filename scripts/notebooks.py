#!/usr/bin/env python3
"""Strips outputs of notebooks, or checks that there are none.

  notebooks.py notebooks              strips all below a folder
  notebooks.py --check notebooks      exit code 1 if one has outputs, execution counts or other changes of running
"""

import argparse
import json
import sys
from pathlib import Path


def stripped(text):
    """The notebook as it is stored: no outputs, no counts, no metadata of an editor."""
    notebook = json.loads(text)
    for cell in notebook["cells"]:
        cell["metadata"] = {}
        if cell["cell_type"] == "code":
            cell["outputs"], cell["execution_count"] = [], None
    notebook["metadata"] = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="change nothing")
    parser.add_argument("folder", type=Path, help="where the notebooks are")
    arguments = parser.parse_args()
    changed = []
    for path in sorted(arguments.folder.glob("*.ipynb")):
        text = path.read_text(encoding="utf-8")
        if stripped(text) != text:
            changed.append(path)
            if not arguments.check:
                path.write_text(stripped(text), encoding="utf-8")
    for path in changed:
        print(f"{path}: {'has outputs: run scripts/notebooks.py' if arguments.check else 'stripped'}")
    return 1 if arguments.check and changed else 0


if __name__ == "__main__":
    sys.exit(main())
