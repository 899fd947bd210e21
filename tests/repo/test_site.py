#!/usr/bin/env python3
"""The HTML of the documents: every link and every picture of every page exists, and the search finds pages in a browser."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse
from html.parser import HTMLParser

from repo_files import ROOT

MAKER = os.path.join(ROOT, "docs", "site", "make_site.py")
PYTHON = next((python for python in (sys.executable, "/usr/bin/python3")
               if os.path.exists(python) and subprocess.run([python, "-c", "import markdown_it"], capture_output=True, check=False).returncode == 0), None)


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src"):
                self.links.append(value)
            elif name == "id":
                self.anchors.add(value)


def dead_links(folder):
    pages = {}
    for position, _, names in os.walk(folder):
        for name in names:
            if name.endswith(".html"):
                with open(os.path.join(position, name), encoding="utf-8") as file:
                    pages[os.path.join(position, name)] = Page(file.read())
    dead = []
    for path, page in pages.items():
        for link in page.links:
            if "://" in link or link.startswith("mailto:"):
                continue
            name, _, anchor = urllib.parse.unquote(link).partition("#")
            target = os.path.normpath(os.path.join(os.path.dirname(path), name)) if name else path
            if not os.path.isfile(target) or (anchor and target in pages and anchor not in pages[target].anchors):
                dead.append(f"{os.path.relpath(path, folder)}: {link}")
    return pages, dead


@unittest.skipUnless(PYTHON, "markdown-it-py is not installed (Debian: python3-markdown-it)")
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        subprocess.run([PYTHON, "-B", MAKER, cls.folder], check=True, capture_output=True)

    def test_no_link_is_dead(self):
        pages, dead = dead_links(self.folder)
        self.assertGreater(len(pages), 40)
        self.assertEqual(dead, [])

    def test_dead_links_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "a.html"), "w", encoding="utf-8") as file:
                file.write('<h2 id="b">B</h2><a href="#b">b</a><a href="#c">c</a><img src="d.png">')
            self.assertEqual(dead_links(folder)[1], ["a.html: #c", "a.html: d.png"])

    @unittest.skipUnless(shutil.which("chromium"), "chromium is not installed")
    def test_the_search_finds_pages_from_disk(self):
        def shown(query):
            with tempfile.TemporaryDirectory() as profile:
                return subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}", "--dump-dom",
                                       f"file://{self.folder}/docs/gait.html?search={query}"],
                                      capture_output=True, text=True, check=True, timeout=120).stdout
        found = shown("dihedral%20angles").partition('<ol id="results">')[2].partition("</ol>")[0]
        self.assertIn('href="../docs/lattices.html#tetrahedra"', found)
        self.assertIn('<ol id="results"></ol>', shown("nosuchwordanywhere"))


@unittest.skipUnless(PYTHON, "markdown-it-py is not installed (Debian: python3-markdown-it)")
class Links(unittest.TestCase):
    def test_code_keeps_texts_like_links(self):
        code = ("import sys; sys.path.insert(0, sys.argv[1]); import make_site; site = make_site.Site(sys.argv[2]);"
                "print(site.converted('docs/x.md', '`a[i](j)` [g](gait.md#b) [n](none.md)\\n## A `b`\\n## A b')); print(site.faults)")
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([PYTHON, "-B", "-c", code, os.path.dirname(MAKER), folder], capture_output=True, text=True, check=True)
        self.assertIn("<code>a[i](j)</code>", done.stdout)
        self.assertIn('href="gait.html#b"', done.stdout)
        self.assertIn('<h2 id="a-b-1">', done.stdout)
        self.assertIn("none.md leads nowhere", done.stdout)


if __name__ == "__main__":
    unittest.main()
