# SPDX-License-Identifier: BSD-3-Clause
"""layers_test.py WARREN: layers above the world on the page of `warren serve`, in a headless Chromium: check boxes by mouse and
keys, what is drawn, the legend, reasons, the link, dark, phone. A word on the console fails a test."""
import os
import subprocess
import sys
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import MapTest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'acceptance'))
from service import Service  # noqa: E402

WARREN = sys.argv.pop(1)
ROOMS = 'bounds 0 0 100 60\nwall 50 -1 50 61\nstart 5 30\ngoal 40 30\n'


class Layers(MapTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        scene, roadmap = (os.path.join(cls.folder.name, name) for name in ('rooms.scene', 'rooms.roadmap'))
        with open(scene, 'w', encoding='utf-8') as file:
            file.write(ROOMS)
        subprocess.run([WARREN, 'build', scene, '--samples', '400', '-o', roadmap, '--quiet'], check=True)
        cls.rooms = Service(WARREN, roadmap, '--writable')
        cls.scene = Service(WARREN, scene)
        cls.maze = Service(WARREN, 'maze:300x300,seed=3')
        cls.bar = Service(WARREN, scene, '--robot', 'polygon -3 -1 3 -1 3 1 -3 1')

    @classmethod
    def tearDownClass(cls):
        for service in (cls.rooms, cls.scene, cls.maze, cls.bar):
            assert service.stop() == 0
        super().tearDownClass()

    def shown(self, service, link=''):
        self.show_map(service.url + link)

    def box(self, name):
        return self.browser.find_element(By.ID, 'layer-' + name)

    def legend(self, name):
        return self.browser.find_element(By.ID, 'layer-' + name + '-legend').text

    def drawn(self, name):
        """Pixels of the layer's tiles that have ink, and how many colours these are."""
        self.wait(lambda: self.run_script('const t = layers.get(arguments[0]).tiles; return t && !t._loading', name))
        return self.run_script('''
            const colors = new Set();
            let inked = 0;
            for (const image of map.getPane("layer-" + arguments[0]).querySelectorAll("img.leaflet-tile-loaded")) {
              const canvas = Object.assign(document.createElement("canvas"), {width: 512, height: 512}), on = canvas.getContext("2d");
              on.drawImage(image, 0, 0);
              const data = on.getImageData(0, 0, 512, 512).data;
              for (let i = 0; i < data.length; i += 4) {
                if (data[i + 3] > 0) ++inked;
                if (data[i + 3] === 255) colors.add(data.slice(i, i + 3).join());
              }
            }
            return [inked, colors.size];''', name)

    def test_a_roadmap_and_its_components_with_legends(self):
        self.shown(self.rooms)
        self.box('roadmap').click()
        self.wait(lambda: '400 milestones' in self.legend('roadmap'))
        inked, colors = self.drawn('roadmap')
        self.assertGreater(inked, 5000)
        self.assertEqual(colors, 1)
        self.box('components').click()
        self.wait(lambda: 'largest' in self.legend('components'))
        self.assertEqual(len(self.legend('components').splitlines()), 2)  # a room on each side of the wall
        self.assertEqual(self.drawn('components')[1], 2)
        self.box('roadmap').click()
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, '.leaflet-layer-roadmap-pane img'), [])
        self.assertEqual(self.legend('roadmap'), '')

    def test_the_link_and_the_keys(self):
        self.shown(self.rooms, '#start=5,30&goal=40,30')
        self.box('roadmap').send_keys(Keys.SPACE)
        self.wait(lambda: 'free edges' in self.legend('roadmap'))
        link = self.run_script('return location.hash')
        self.assertIn('layers=roadmap', link)
        self.shown(self.rooms, link)
        self.assertEqual([self.box(name).is_selected() for name in ('roadmap', 'components')], [True, False])
        self.assertGreater(self.drawn('roadmap')[0], 5000)
        self.shown(self.rooms, '#layers=walls,constructor')
        self.assertFalse(self.box('roadmap').is_selected())

    def unfold(self):
        """Layers that this world has not, and why."""
        self.press('layers-none-count')

    def test_a_world_without_a_roadmap_says_why(self):
        self.shown(self.scene, '#layers=roadmap')
        self.unfold()
        for name in ('roadmap', 'components'):
            self.assertFalse(self.box(name).is_enabled())
            self.assertFalse(self.box(name).is_selected())
            self.assertIn('open a roadmap', self.legend(name))

    def test_clearance_and_axis_with_legends(self):
        self.shown(self.scene)
        self.box('clearance').click()
        self.wait(lambda: self.legend('clearance').endswith('and more'))
        self.assertTrue(self.legend('clearance').startswith('0 to '))
        self.assertGreater(self.drawn('clearance')[0], 50000)
        self.box('axis').click()
        self.wait(lambda: 'as far from all obstacles' in self.legend('axis'))
        self.assertGreater(self.drawn('axis')[0], 100)  # a ridge of 10 units in the middle of each room
        self.assertIn('layers=clearance,axis', self.run_script('return decodeURIComponent(location.hash)'))
        self.browser.set_window_size(400, 860)
        self.shown(self.scene, '#layers=clearance')
        self.wait(lambda: 'and more' in self.legend('clearance'))
        self.assertNotIn('Zoom in', self.legend('clearance'))  # the whole world is smaller than a tile
        self.shown(self.maze)
        self.unfold()
        self.assertIn('passages', self.legend('axis'))

    def test_the_search_follows_the_start(self):
        self.shown(self.rooms, '#start=5,30&goal=40,30')
        self.box('search').click()
        self.wait(lambda: 'from the start' in self.legend('search'))
        self.assertIn('does not reach', self.legend('search'))  # the other room
        self.assertGreater(self.drawn('search')[1], 4)
        before = self.legend('search')
        self.run_script('setEnd("start", {x: 25, y: 30})')
        self.wait(lambda: self.legend('search') not in ('', before))
        self.run_script('byId("clear").click()')
        self.wait(lambda: 'where there is an answer' in self.legend('search'))
        self.shown(self.scene)
        self.assertFalse(self.box('search').is_enabled())

    def test_passages_are_seen_from_near(self):
        self.shown(self.maze)
        self.box('roadmap').click()
        self.wait(lambda: 'Zoom in' in self.legend('roadmap'))
        self.assertIn('89 999 passages', self.legend('roadmap'))
        self.run_script('map.setView([150, 150], layers.get("roadmap").account.from_zoom, {animate: false})')
        self.wait(lambda: 'Zoom in' not in self.legend('roadmap'))
        self.assertGreater(self.drawn('roadmap')[0], 5000)
        self.assertFalse(self.box('components').is_enabled())

    def sweep(self):
        """Bodies that are drawn, the box around them and the legend's words."""
        return self.run_script('''
            const bodies = sweep.bodies ? sweep.bodies.getLayers() : [];
            const box = L.latLngBounds(bodies.flatMap(body => body.getLatLngs ? body.getLatLngs() : [body.getLatLng()]).flat());
            return [bodies.length, bodies.length ? [box.getWest(), box.getEast()] : null];''')

    def test_the_sweep_follows_the_path(self):
        self.shown(self.bar, '#start=8,30,0&goal=40,30,0&layers=sweep')
        self.wait(lambda: 'along the path' in self.legend('sweep'))
        count, (west, east) = self.sweep()
        self.assertGreater(count, 10)  # 32 of way, a body every 12 pixels
        self.assertLess(abs(west - 5), 1e-9)  # the reference point at 8, its outline 3 before it
        self.assertLess(abs(east - 43), 1e-9)
        self.run_script('setEnd("goal", {x: 20, y: 30})')
        self.wait(lambda: (self.sweep()[1] or [0, 43])[1] < 24)  # one look: between two there may be none
        self.assertIn('layers=sweep', self.run_script('return location.hash'))
        self.run_script('byId("clear").click()')
        self.wait(lambda: 'where there is a path' in self.legend('sweep'))
        self.assertEqual(self.sweep()[0], 0)
        self.box('sweep').click()
        self.assertEqual(self.legend('sweep'), '')
        self.box('sweep').click()
        self.assertIn('where there is a path', self.legend('sweep'))

    def test_a_point_has_no_sweep(self):
        self.shown(self.scene)
        self.assertFalse(self.box('sweep').is_enabled())
        self.assertEqual(self.legend('sweep'), '')  # in a fold
        self.unfold()
        self.assertIn('no extent', self.legend('sweep'))

    def test_a_changed_world_has_its_own(self):
        self.shown(self.rooms, '#layers=components')
        before, _ = self.drawn('components')
        old = self.run_script('return layers.get("components").tiles._url')
        self.async_script('draw({add: {polygons: [[[60, 10], [90, 10], [90, 50], [60, 50]]]}}).then(done)')
        self.assertNotEqual(self.run_script('return layers.get("components").tiles._url'), old)
        self.assertLess(self.drawn('components')[0], 0.8 * before)
        self.async_script('stepDrawing(drawing.undo, drawing.redo).then(done)')
        self.assertEqual(self.drawn('components')[0], before)

    def colors(self, *places):
        """What a screenshot shows there, [red, green, blue] each."""
        return self.async_script('''
            const [picture, places] = arguments, frame = map.getContainer().getBoundingClientRect();
            const bytes = Uint8Array.from(atob(picture), letter => letter.charCodeAt(0));
            createImageBitmap(new Blob([bytes], {type: "image/png"})).then(image => {
              const pen = new OffscreenCanvas(image.width, image.height).getContext("2d", {willReadFrequently: true});
              pen.drawImage(image, 0, 0);
              done(places.map(([x, y]) => {
                const at = map.latLngToContainerPoint([y, x]);
                return [...pen.getImageData(Math.round(frame.x + at.x), Math.round(frame.y + at.y), 1, 1).data].slice(0, 3);
              }));
            });''', self.browser.get_screenshot_as_base64(), places)

    def test_clearance_stands_out_on_white_and_on_dark_and_so_do_walls_in_it(self):
        def luminance(color):
            shares = [part / 255 for part in color]
            red, green, blue = [s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4 for s in shares]
            return 0.2126 * red + 0.7152 * green + 0.0722 * blue

        def contrast(one, other):
            low, high = sorted(luminance(color) + 0.05 for color in (one, other))
            return high / low

        for scheme in ('light', 'dark'):
            self.media(color_scheme=scheme)
            self.shown(self.scene, '#start=&goal=&layers=clearance')
            self.drawn('clearance')
            self.wait(lambda: self.legend('clearance').endswith('and more'))
            self.rest()
            paper, wall, *inked = self.colors((-2, 35), (50, 30), (48, 20), (25, 30), (12, 30), (90, 10))
            self.assertIn(paper, ([255, 255, 255], [0, 0, 0]))
            for color in inked:
                self.assertGreater(contrast(color, paper), 1.9, (scheme, color))
                self.assertGreater(contrast(color, wall), 1.9, (scheme, color, wall))
            looks = self.run_script('return [".clearance.layer", ".clearance .ink"].map(name => getComputedStyle(document.querySelector(name)).filter)')
            self.assertEqual(looks[0], looks[1])

    def rewritten(self, name, script):
        """How often the legend is written while the script runs, which calls done()."""
        self.run_script('''
            window.writes = 0;
            new MutationObserver(records => { writes += records.length; }).observe(byId("layer-" + arguments[0] + "-legend"), {childList: true, subtree: true});''', name)
        self.async_script(script)
        self.frames()
        return self.run_script('return writes')

    def test_a_legend_that_says_the_same_is_not_read_out_again(self):
        self.shown(self.maze, '#layers=roadmap')
        self.wait(lambda: 'Zoom in' in self.legend('roadmap'))
        self.assertEqual(self.rewritten('roadmap', 'showLegend(layers.get("roadmap")).then(done)'), 0)
        self.assertGreater(self.rewritten('roadmap', 'map.setZoom(layers.get("roadmap").account.from_zoom, {animate: false}); showLegend(layers.get("roadmap")).then(done)'), 0)
        self.shown(self.bar, '#start=8,30,0&goal=40,30,0&layers=sweep')
        self.wait(lambda: 'along the path' in self.legend('sweep'))
        self.assertEqual(self.rewritten('sweep', 'map.panBy([5, 5], {animate: false}); showSweep().then(done)'), 0)
        self.assertGreater(self.sweep()[0], 10)

    def test_lines_stand_out_in_dark_too(self):
        self.shown(self.rooms, '#start=5,30&goal=40,30&layers=search')
        self.wait(lambda: 'from the start' in self.legend('search'))
        self.drawn('search')
        for dark in (False, True):
            self.run_script('setDark(arguments[0])', dark)
            filters = self.run_script('''return [map.getPane("layer-search").querySelector(".layer"), layers.get("search").words.querySelector(".ink")]
                .map(element => getComputedStyle(element).filter)''')
            self.assertEqual([kind.startswith('invert') for kind in filters], [dark, dark])

    def test_dark_and_phone(self):
        self.media(color_scheme='dark')
        self.shown(self.rooms, '#layers=roadmap,components')
        self.wait(lambda: 'largest' in self.legend('components'))
        self.browser.set_window_size(500, 900)
        self.wait(lambda: self.run_script('return innerHeight') > 600)
        self.rest()
        box = self.box('components')
        self.run_script('arguments[0].scrollIntoView({block: "center"})', box)
        box.click()
        self.assertFalse(box.is_selected())
        self.assertLessEqual(self.run_script('return document.documentElement.scrollWidth'), self.run_script('return innerWidth'))


if __name__ == '__main__':
    unittest.main()
