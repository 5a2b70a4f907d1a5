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
        """What the service refuses, and tiles of a world that is no more, are on the console by the browser's own word."""
        said = [entry for entry in self.browser.get_log('browser')
                if entry['source'] != 'network' or not ('/api/update' in entry['message'] or '/v/' in entry['message'])]
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

    def test_an_undo_while_the_one_before_is_on_its_way_takes_nothing_twice(self):
        service = self.served('--writable', link='#planner=visibility')
        self.wait_for_length(lambda length: length == 90)
        self.async_script('(async () => {'
                          'await draw({add: {walls: [[50, 5, 50, 10]]}}); await draw({add: {walls: [[60, 5, 60, 10]]}});'
                          'await draw({remove: {walls: [[60, 5, 60, 10]]}}); done(); })();')
        self.assertEqual(self.run_script('return drawing.undo.length'), 3)
        self.run_script('window.quick = fetchWorld; window.go = null;'
                        'fetchWorld = async () => { await new Promise(then => { go = then; }); return quick(); }; stepDrawing(drawing.undo, drawing.redo);')
        self.wait(lambda: self.run_script('return go !== null'))
        self.run_script('stepDrawing(drawing.undo, drawing.redo); go();')
        self.wait(lambda: self.run_script('return !drawing.busy && drawing.undo.length') == 2)
        scene = service.request('GET', '/api/scene')[2].decode()
        self.assertEqual(scene.count('60 5 60 10'), 1, scene)
        self.assertEqual(self.run_script('fetchWorld = quick; return [drawing.undo.length, drawing.redo.length]'), [2, 1])

    def test_what_is_refused_stays_to_be_mended(self):
        self.served('--writable', link='#planner=visibility')
        self.wait_for_length(lambda length: length == 90)
        self.press('draw-polygon')
        for place in ((60, 10), (80, 50), (80, 10), (60, 50)):
            self.click_at(*place)
        self.by_id('map').send_keys(Keys.ENTER)
        self.wait(lambda: 'cross' in self.status())
        self.assertEqual(self.run_script('return drawing.corners.length'), 4)

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

    def change_beside_the_page(self, service, **change):
        """What somebody else does. The new world's hash."""
        status, _, text = service.request('POST', '/api/update', json.dumps(change), Content_Type='application/json')
        self.assertEqual(status, 200, text)
        return json.loads(text)['hash']

    def test_what_somebody_else_draws_is_seen_with_the_next_answer(self):
        service = self.served('--writable', link='#planner=visibility&layers=clearance')
        self.wait_for_length(lambda length: length == 90)
        hashed = self.change_beside_the_page(service, add={'walls': [[50, 5, 50, 55]]})
        self.run_script('ask()')
        self.wait(lambda: hashed in self.run_script('return tiles._url'))
        self.wait_for_length(lambda length: length > 95)
        self.assertIn(hashed, self.run_script('return layers.get("clearance").tiles._url'))

    def test_a_tile_of_a_world_that_is_no_more_brings_the_new_one(self):
        service = self.served('--writable', link='#planner=visibility')
        self.wait_for_length(lambda length: length == 90)
        hashed = self.change_beside_the_page(service, add={'walls': [[50, 5, 50, 55]]})
        self.run_script('map.setView([30, 50], 3, {animate: false})')
        self.wait(lambda: hashed in self.run_script('return tiles._url'))
        self.wait_for_length(lambda length: length > 95)

    def test_a_wall_outside_makes_the_map_larger_and_loses_nothing(self):
        self.served('--writable', link='#planner=visibility')
        self.wait_for_length(lambda length: length == 90)
        self.run_script('window.same = true; addNode({x: 10, y: 10}); addNode({x: 20, y: 10}, [...graph.nodes.keys()][0]); setMeasuring(true);'
                        'addMeasured(L.latLng(50, 10)); addMeasured(L.latLng(50, 90)); setMeasuring(false)')
        before = self.run_script('return [world.tiles.span, graph.nodes.size, graph.undo.length, measuring.points.length]')
        self.by_id('draw-shape').send_keys('50, 5, 50, 400', Keys.ENTER)
        self.wait_for_length(lambda length: length > 95)
        self.assertTrue(self.run_script('return window.same === true'))
        after = self.run_script('return [world.tiles.span, graph.nodes.size, graph.undo.length, measuring.points.length]')
        self.assertGreater(after[0], before[0])
        self.assertEqual(after[1:], before[1:])
        self.press('whole')
        self.wait(lambda: self.run_script('return map.getBounds().contains([400, 50]) && !tiles._loading && !map._animatingZoom'))
        self.assertIn(self.run_script('return world.hash'), self.run_script('return document.querySelector(".tiles img.leaflet-tile-loaded").src'))
        self.assertTrue(self.wall_is_drawn_at(50, 300))
        self.run_script('setEnd("goal", {x: 95, y: 50})')
        self.wait_for_length(lambda length: length > 95)
        self.run_script('setTool(drawing.tool)')  # lays it down
        self.click_at(60, 200)
        self.assertAlmostEqual(self.run_script('return question.goal.y'), 200, delta=2)
        self.run_script('setEnd("goal", {x: 95, y: 30})')
        self.press('draw-undo')
        self.wait_for_length(lambda length: length == 90)
        self.assertEqual(self.run_script('return world.tiles.span'), before[0])
        self.assertTrue(self.wall_is_drawn_at(30, 10))

    def wall_is_drawn_at(self, x, y):
        """Dark pixels of the tiles around the place."""
        self.wait(lambda: self.run_script('return !tiles._loading'))
        return self.run_script('''
            const at = map.latLngToContainerPoint([arguments[1], arguments[0]]), box = map.getContainer().getBoundingClientRect();
            return [...document.querySelectorAll(".tiles img.leaflet-tile-loaded")].some(image => {
              const r = image.getBoundingClientRect(), times = 512 / r.width;
              const canvas = Object.assign(document.createElement("canvas"), {width: 512, height: 512}), on = canvas.getContext("2d");
              on.drawImage(image, 0, 0);
              const data = on.getImageData((box.left + at.x - r.left) * times - 3, (box.top + at.y - r.top) * times - 3, 6, 6).data;
              return data.some((value, i) => i % 4 === 3 && value > 100);
            });''', x, y)

    def test_verdicts_of_the_old_world_that_come_late_are_asked_for_again(self):
        self.served('--writable', link='#planner=visibility')
        self.wait_for_length(lambda length: length == 90)
        self.run_script('''
            window.late = null;
            const asks = fetch;
            fetch = async (place, ...more) => {
              const reply = await asks(place, ...more);
              if (place === "api/check" && !late) await new Promise(done => { late = done; });
              return reply;
            };
            addNode({x: 60, y: 10});
            addNode({x: 90, y: 10}, [...graph.nodes.keys()][0]);''')
        self.wait(lambda: self.run_script('return late !== null'))
        self.async_script('draw({add: {walls: [[75, 5, 75, 15]]}}).then(done)')
        self.run_script('late()')
        self.wait(lambda: self.run_script('return [...graph.edges.values()].every(verdictOf)'))
        self.assertEqual(self.run_script('return blockedEdges().length'), 2)

    def test_where_nobody_may_draw_there_is_nothing_to_draw_with(self):
        self.served()
        self.assertFalse(self.by_id('drawing').is_displayed())


if __name__ == '__main__':
    unittest.main()
