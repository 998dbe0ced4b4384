"""Applies the code blocks of docs/extending.md to copies of the files that it names.

    apply_blocks.py EXTENDING.md SOURCE_FOLDER OUTPUT_FOLDER

A block is applied if the paragraph before it says where it goes:

    New file `PATH`:
    In `PATH`, after the line with `TEXT`:
    In `PATH`, before the line with `TEXT`:
    In `PATH`, in place of the line with `TEXT`:

TEXT must be in exactly one line of the file, so that a reader finds it too. The file
`changed_files` in OUTPUT_FOLDER lists the copies; a copy that is as it should be is not written
again.
"""
import pathlib
import re
import sys

NEW = re.compile(r"^New file `([^`]+)`:$")
EDIT = re.compile(r"^In `([^`]+)`, (after|before|in place of) the line with `([^`]+)`:$")
WHERE = re.compile(r"^(New file|In) `")


def blocks(text):
    """(the paragraph above the block on one line, the block) of every fenced block."""
    lines = text.splitlines()
    above, i = "", 0
    while i < len(lines):
        if lines[i].startswith("```"):
            end = lines.index("```", i + 1)
            yield above, lines[i + 1 : end]
            above, i = "", end
        elif lines[i].strip():
            above = f"{above} {lines[i]}" if above and lines[i - 1].strip() else lines[i]
        i += 1


def main(document, source, output):
    files = {}
    for above, block in blocks(pathlib.Path(document).read_text()):
        new, edit = NEW.match(above), EDIT.match(above)
        if new:
            if (source / new[1]).exists() or new[1] in files:
                sys.exit(f"{document}: {new[1]} is not new")
            files[new[1]] = block
        elif edit:
            path, where, text = edit.groups()
            lines = files.get(path) or (source / path).read_text().splitlines()
            found = [i for i, line in enumerate(lines) if text in line]
            if len(found) != 1:
                sys.exit(f"{document}: {len(found)} lines of {path} have `{text}`")
            first, last = {"after": (1, 1), "before": (0, 0), "in place of": (0, 1)}[where]
            files[path] = lines[: found[0] + first] + block + lines[found[0] + last :]
        elif WHERE.match(above):
            sys.exit(f"{document}: not understood: {above}")
    for path, lines in files.items():
        target = output / path
        target.parent.mkdir(parents=True, exist_ok=True)
        text = "\n".join(lines) + "\n"
        # A change of the page's prose alone compiles nothing again.
        if not target.exists() or target.read_text() != text:
            target.write_text(text)
    (output / "changed_files").write_text("".join(f"{path}\n" for path in sorted(files)))


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
