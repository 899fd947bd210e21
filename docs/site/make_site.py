#!/usr/bin/env python3
"""Makes HTML of all documents, which opens from disk and can be searched.

    docs/site/make_site.py OUT      markdown-it-py is needed (Debian: python3-markdown-it)

Pages keep the folders of the repository: docs/gait.md becomes OUT/docs/gait.html. A file that a page links to is copied; a folder
becomes a page with its README or its list of files. OUT/search_index.js holds the text of each section."""
import html
import json
import os
import posixpath
import re
import shutil
import subprocess
import sys
import urllib.parse
from html.parser import HTMLParser

from anchors import FENCE, anchor_of

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
HERE = os.path.dirname(os.path.abspath(__file__))
NAVIGATION = re.compile(r"^## Documentation\n(.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)
API = "api/html/index.html"
MISSING = 2  # exit status: a package is missing


def tracked_files():
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            capture_output=True, check=True).stdout.decode()
    return {name for name in listed.split("\0") if name and os.path.isfile(os.path.join(ROOT, name))}


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def page_of(path):
    """The page of a document."""
    return "index.html" if path == "README.md" else path[:-len(".md")] + ".html"


class Sections(HTMLParser):
    """The plain text of a page, cut at its headings."""

    def __init__(self):
        super().__init__()
        self.found, self.in_heading = [["", "", ""]], False

    def handle_starttag(self, tag, attributes):
        if re.fullmatch("h[1-6]", tag):
            self.found.append([dict(attributes).get("id", ""), "", ""])
            self.in_heading = True

    def handle_endtag(self, tag):
        if re.fullmatch("h[1-6]", tag):
            self.in_heading = False

    def handle_data(self, data):
        self.found[-1][1 if self.in_heading else 2] += data if self.in_heading else data + " "


class Site:
    def __init__(self, out):
        from markdown_it import MarkdownIt  # where it is missing, main() has said so
        self.out, self.files, self.made, self.index, self.faults = out, tracked_files(), set(), [], []
        self.markdown = MarkdownIt("commonmark").enable("table")
        self.waiting = ["README.md"] + sorted(name for name in self.files if re.fullmatch(r"(docs|spec)/[^/]+\.md", name))
        self.navigation = NAVIGATION.search(read("README.md"))[1]

    def write(self, path, text):
        path = os.path.join(self.out, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def target(self, document, link):
        """What a link of a document becomes. Documents, files and folders that it names are made as well."""
        if "://" in link or link.startswith(("#", "mailto:")):
            return link
        name, _, anchor = link.partition("#")
        path = posixpath.normpath(posixpath.join(posixpath.dirname(document), name))
        if path in self.files and path.endswith(".md"):
            self.waiting.append(path)
            page = page_of(path)
        elif path in self.files:
            page = path
            if path not in self.made:
                self.made.add(path)
                os.makedirs(os.path.join(self.out, os.path.dirname(path)), exist_ok=True)
                shutil.copyfile(os.path.join(ROOT, path), os.path.join(self.out, path))
        elif any(file.startswith(path + "/") for file in self.files):
            page = self.folder_page(path)
        else:
            self.faults.append(f"{document}: the link to {link} leads nowhere")
            return link
        here = posixpath.dirname(page_of(document))
        return posixpath.relpath(page, here or ".") + (f"#{anchor}" if anchor else "")

    def folder_page(self, path):
        if f"{path}/README.md" in self.files:
            self.waiting.append(f"{path}/README.md")
            return page_of(f"{path}/README.md")
        page = f"{path}/index.html"
        if page not in self.made:
            self.made.add(page)
            names = sorted({file[len(path) + 1:].split("/")[0] for file in self.files if file.startswith(path + "/")})
            rows = "".join(f"<li>{html.escape(name)}</li>" for name in names)
            self.write(page, self.whole(page, path, f"<h1>{html.escape(path)}</h1><ul>{rows}</ul>"))
        return page

    def converted(self, document, text):
        """HTML of Markdown, with anchors at headings and with links as the site has them."""
        tokens, names = self.markdown.parse(text), []
        for token, following in zip(tokens, tokens[1:] + [None]):
            if token.type == "heading_open":
                token.attrSet("id", anchor_of(following.content, names))
            for child in token.children or ():
                for name in ("href", "src"):
                    if child.attrGet(name):
                        child.attrSet(name, self.target(document, urllib.parse.unquote(child.attrGet(name))))
        return self.markdown.renderer.render(tokens, self.markdown.options, {})

    def whole(self, page, title, body):
        up = posixpath.relpath(".", posixpath.dirname(page) or ".")
        menu = self.converted_menu(page)
        api = f'<p><a href="{up}/{API}">API reference</a></p>' if os.path.exists(os.path.join(self.out, API)) else ""
        return (f'<!doctype html>\n<html lang="en">\n<head><meta charset="utf-8"><title>{html.escape(title)} - sbfmt</title>\n'
                '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
                f'<link rel="stylesheet" href="{up}/site.css"></head>\n<body data-top="{up}">\n<nav><p><a href="{up}/index.html">sbfmt</a></p>'
                '<input id="search" type="search" aria-label="Search" title="Search"><ol id="results"></ol>'
                f'{menu}{api}</nav>\n<main>\n{body}\n</main>\n<script src="{up}/search_index.js"></script>'
                f'<script src="{up}/search.js"></script>\n</body>\n</html>\n')

    def converted_menu(self, page):
        """The table of the README's documents, as lists."""
        rows, here = "", posixpath.dirname(page) or "."
        for title, links in re.findall(r"^\| ([^|]+) \| (.*\]\(.*) \|$", self.navigation, re.MULTILINE):
            items = "".join(f'<li><a href="{posixpath.relpath(page_of(path) if path.endswith(".md") else path, here)}">{html.escape(name)}</a></li>'
                            for name, path in re.findall(r"\[([^\]]*)\]\(([^)#]+)\)", links))
            rows += f"<h2>{html.escape(title)}</h2><ul>{items}</ul>"
        return rows

    def document(self, path):
        page, text = page_of(path), read(path)
        title = re.search(r"^# (.+)$", FENCE.sub("", text), re.MULTILINE)[1].replace("`", "")
        body = self.converted(path, text)
        self.write(page, self.whole(page, title, body))
        sections = Sections()
        sections.feed(body)
        for anchor, heading, words in sections.found:
            if words.strip() or heading:
                self.index.append([title, heading if heading != title else "", page + (f"#{anchor}" if anchor else ""),
                                   " ".join(words.split())])

    def make(self):
        while self.waiting:
            path = self.waiting.pop(0)
            if path not in self.made:
                self.made.add(path)
                self.document(path)
        self.write("search_index.js", "const searchIndex = " + json.dumps(self.index, ensure_ascii=False).replace("</", "<\\/") + ";\n")
        for name in ("site.css", "search.js"):
            shutil.copyfile(os.path.join(HERE, name), os.path.join(self.out, name))
        return sum(name.endswith(".md") for name in self.made)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        site = Site(sys.argv[1])
    except ModuleNotFoundError:
        print(f"make_site.py: {sys.executable} has no markdown-it-py; install python3-markdown-it", file=sys.stderr)
        sys.exit(MISSING)
    count = site.make()
    if site.faults:
        sys.exit("\n".join(site.faults))
    print(f"{count} pages in {sys.argv[1]}")


if __name__ == "__main__":
    main()
