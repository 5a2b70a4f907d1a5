# SPDX-License-Identifier: BSD-3-Clause
"""drawing_test.py WARREN: walls and polygons drawn into a served world in a headless Chromium: the path goes around them,
changes are taken back, and the saved scene gives the same answer."""
import json
import os
import subprocess
import sys
import unittest

from selenium.webdriver.common.keys import Keys

from browser import MapTest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'acceptance'))
from service import Service  # noqa: E402

WARREN = sys.argv.pop(1)
YARD = 'bounds 0 0 100 60\nwall 30 0 30 20\nstart 5 30\ngoal 95 30\n'
TOKEN = 'a-token-of-20-letters'


class Drawing(MapTest):
    def setUp(self):
        super().setUp()
        with open(self.path('yard.scene'), 'w', encoding='utf-8') as file:
            file.write(YARD)
        with open(self.path('token'), 'w', encoding='utf-8') as file:
            file.write(TOKEN)

    def tearDown(self):
        said = [entry for entry in self.browser.get_log('browser') if entry['source'] != 'network' or '/api/update' not in entry['message']]
        self.assertEqual(said, [])

    def served(self, *words, link=''):
        service = Service(WARREN, self.path('yard.scene'), *words)
        self.addCleanup(service.stop)
        self.show_map(service.url + link)
        self.run_script('byId("drawing").open = true; window.saved = []; save = (name, type, text) => saved.push(text);')
        return service

    def length(self):
        return self.run_script('return answer.json && answer.json.verified ? answer.json.length : null')

    def wait_for_length(self, fits):
        self.wait(lambda: self.length() is not None and fits(self.length()))

    def test_a_wall_across_the_path_is_gone_around_and_taken_back(self):
        self.served('--writable', link='#planner=visibility')
        self.wait_for_length(lambda length: length == 90)
        self.press('draw-wall')
        for place in ((50, 5), (50, 55), (50, 55)):
            self.click_at(*place)
        self.wait_for_length(lambda length: length > 95)
        around = self.length()
        self.press('draw-undo')
        self.wait_for_length(lambda length: length == 90)
        self.press('draw-redo')
        self.wait_for_length(lambda length: length == around)
        self.press('copy-command')
        self.assertTrue(self.by_id('copied').get_attribute('value').startswith('warren solve world.scene '))
        self.press('draw-save')
        self.wait(lambda: self.run_script('return saved.length') == 1)
        with open(self.path('saved.scene'), 'w', encoding='utf-8') as file:
            file.write(self.run_script('return saved[0]'))
        told = subprocess.run([WARREN, 'solve', self.path('saved.scene'), '--planner', 'visibility', '--json', '-'], capture_output=True, text=True, check=True)
        again = json.loads(told.stdout)
        self.assertEqual(again['path'], self.run_script('return answer.json.path'))
        self.assertEqual(again['world']['hash'], self.run_script('return answer.json.world.hash'))

    def test_polygons_by_mouse_and_keys_and_the_eraser(self):
        self.served('--writable', link='#planner=visibility')
        self.wait_for_length(lambda length: length == 90)
        self.press('draw-polygon')
        for place in ((60, 10), (80, 10), (80, 50), (60, 50)):
            self.click_at(*place)
        self.by_id('map').send_keys(Keys.ENTER)
        self.wait_for_length(lambda length: length > 95)
        shown = self.run_script('return tiles._url')
        self.assertIn(self.run_script('return answer.json.world.hash'), shown)
        self.press('draw-erase')
        self.click_at(70, 40)
        self.wait_for_length(lambda length: length == 90)
        field = self.by_id('draw-shape')
        field.send_keys('50, 5, 50, 55', Keys.ENTER)
        self.wait_for_length(lambda length: length > 95)
        self.by_id('map').send_keys(Keys.CONTROL + 'z' + Keys.NULL)
        self.wait_for_length(lambda length: length == 90)
        self.press('draw-polygon')
        for place in ((60, 10), (80, 50), (80, 10), (60, 50)):
            self.click_at(*place)
        self.by_id('map').send_keys(Keys.ENTER)
        self.wait(lambda: 'polygon' in self.status() and 'cross' in self.status())
        self.assertEqual(self.length(), 90)

    def test_a_token_comes_by_the_link_and_leaves_the_address(self):
        self.served('--writable', '--token-file', self.path('token'), link='#planner=visibility')
        self.wait_for_length(lambda length: length == 90)
        field = self.by_id('draw-shape')
        field.send_keys('50, 5, 50, 55', Keys.ENTER)
        self.wait(lambda: 'token' in self.status())
        self.served('--writable', '--token-file', self.path('token'), link='#planner=visibility&token=' + TOKEN)
        self.wait_for_length(lambda length: length == 90)
        self.by_id('draw-shape').send_keys('50, 5, 50, 55', Keys.ENTER)
        self.wait_for_length(lambda length: length > 95)
        self.assertNotIn('token', self.run_script('return location.href'))

    def test_where_nobody_may_draw_there_is_nothing_to_draw_with(self):
        self.served()
        self.assertFalse(self.by_id('drawing').is_displayed())


if __name__ == '__main__':
    unittest.main()
