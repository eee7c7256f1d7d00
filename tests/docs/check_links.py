"""Relative links of every Markdown page: is there such a file, and such a heading in it?

    check_links.py REPOSITORY
"""

import re
import subprocess
import sys
from pathlib import Path

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```", re.M | re.S)
CODE = re.compile(r"`[^`\n]*`")


def anchors(page):
    """Headings as GitHub names them: lower case, without punctuation, spaces as hyphens, a number behind those that come again."""
    names = set()
    for line in FENCE.sub("", page.read_text(encoding="utf-8")).splitlines():
        heading = re.match(r"#{1,6} +(.*)", line)
        if not heading:
            continue
        name = re.sub(r"[^\w\- ]", "", heading.group(1).strip().lower()).replace(" ", "-")
        unique, count = name, 0
        while unique in names:
            count += 1
            unique = f"{name}-{count}"
        names.add(unique)
    return names


def problems_of(page):
    text = CODE.sub("", FENCE.sub("", page.read_text(encoding="utf-8")))
    for target in LINK.findall(text):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            yield f"{target}: there is no such file"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield f"{target}: {file.name} has no such heading"


def main(root):
    # Without git, as in an unpacked archive, all pages but those of what was fetched or built.
    listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", "*.md"], capture_output=True, text=True)
    if listed.returncode == 0:
        pages = [root / name for name in listed.stdout.splitlines() if (root / name).exists()]
    else:
        pages = [p for p in root.rglob("*.md") if not {".deps", "build", "out", "node_modules"} & set(p.relative_to(root).parts)]
    found = [f"{page.relative_to(root)}: {problem}" for page in pages for problem in problems_of(page)]
    print(*found, sep="\n")
    if not pages:
        sys.exit("no pages were found")
    print(f"{len(pages)} pages, {len(found)} links that lead nowhere")
    sys.exit(bool(found))


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
