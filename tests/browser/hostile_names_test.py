# SPDX-License-Identifier: BSD-3-Clause
"""hostile_names_test.py WARREN: titles and names of files that would like to run something are shown as the text that they
are, by pages, reports and SVG, in a headless Chromium."""
import os
import subprocess
import sys
import unittest

from browser import BrowserTest

WARREN = sys.argv.pop(1)
WORLD = 'bounds 0 0 9 6\npolygon 3 1 5 1 5 4 3 4\nstart 1 2\ngoal 8 3\n'
TITLES = ['<script>window.ran = 1</script>', '</script><script>window.ran = 1</script>', '</title></style><img src=x onerror="window.ran = 1">',
          '"><svg onload=window.ran=1>', "' onmouseover='window.ran=1", '<!--', ']]><script>window.ran=1</script>', '&lt;b&gt; &amp;amp; &#60;',
          '{"a": "\\u003cscript>"}', '%3Cscript%3E', '=HYPERLINK("http://x")', 'ends with a backslash \\', '(a) \\) Tj', 'long ' * 2000]
UNSEEN = {'a\x1b[31mb\x07c': 'a?[31mb?c', 'txt.\u202egnp': 'txt.?gnp', 'a\u200fb\ufffec': 'a?b?c', 'zero\u200bwidth': 'zero?width'}


class HostileNames(BrowserTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # A path may hold all but NUL; a slash closes the tag.
        folder = os.path.join(cls.folder.name, '<img src=x onerror=window.ran=1><')
        os.makedirs(folder)
        cls.world = os.path.join(folder, 'script><script>window.ran=1<')
        os.makedirs(cls.world)
        cls.world += '/script>"\'&.scene'
        with open(cls.world, 'w', encoding='utf-8') as file:
            file.write(WORLD)

    def warren(self, *words):
        subprocess.run([WARREN, *words, '--quiet'], check=True, stdout=subprocess.DEVNULL)

    def seen(self, title, name):
        self.warren('solve', self.world, '--title', title, '--svg', self.path(name))
        self.open(name)

    def expect_nothing_ran(self, scripts):
        self.assertIsNone(self.run_script('return window.ran ?? null'))
        self.assertEqual(self.run_script('return document.querySelectorAll("script").length'), scripts)
        self.assertEqual(self.run_script('return document.querySelectorAll("img, [onload], [onerror], [onmouseover], a, iframe, object").length'), 0)

    def test_pages_show_titles_as_text(self):
        for title in TITLES:
            with self.subTest(title[:40]):
                self.seen(title, 'page.html')
                self.frames()
                self.expect_nothing_ran(7)
                self.assertEqual(self.run_script('return [document.title, document.getElementById("title").textContent]'),
                                 [title.strip(), title])

    def test_svg_shows_titles_as_text(self):
        for title in TITLES:
            with self.subTest(title[:40]):
                self.seen(title, 'picture.svg')
                self.expect_nothing_ran(0)
                self.assertEqual(self.run_script('return document.querySelector("title").textContent'), title)

    def test_what_cannot_be_seen_is_a_question_mark(self):
        for title, shown in UNSEEN.items():
            for name in ('page.html', 'picture.svg'):
                with self.subTest(ascii(title) + name):
                    self.seen(title, name)
                    self.assertEqual(self.run_script('return document.querySelector("title").textContent'), shown)

    def test_names_of_worlds_are_text_in_pages_reports_and_svg(self):
        self.warren('solve', self.world, '--svg', self.path('page.html'))
        self.warren('solve', self.world, '--svg', self.path('picture.svg'))
        self.warren('compare', self.world, '--planners', 'visibility,prm', '--seeds', '2', '--html', self.path('report.html'),
                    '--svg', self.path('report.svg'))
        self.warren('build', self.world, '--samples', '50', '-o', self.path('r.roadmap'))
        self.warren('render', self.path('r.roadmap'), '-o', self.path('roadmap.html'))
        for name, scripts in (('page.html', 7), ('picture.svg', 0), ('report.html', 1), ('report.svg', 0), ('roadmap.html', 7)):
            with self.subTest(name):
                self.open(name)
                if name.endswith('.html'):
                    self.frames()
                self.expect_nothing_ran(scripts)

    def test_a_page_runs_no_script_but_its_own(self):
        self.warren('compare', self.world, '--planners', 'prm', '--seeds', '2', '--html', self.path('report.html'))
        self.seen('plain', 'page.html')
        for name in ('page.html', 'report.html'):
            self.open(name)
            self.run_script('''const script = document.createElement("script");
                script.textContent = "window.ran = 1";
                document.body.append(script);
                document.body.insertAdjacentHTML("beforeend", "<button id=trap onclick='window.ran = 1'>x</button>");''')
            self.run_script('document.getElementById("trap").click()')
            self.assertIsNone(self.run_script('return window.ran ?? null'))
            self.assertIn('Content Security Policy', str(self.browser.get_log('browser')))


if __name__ == '__main__':
    unittest.main()
