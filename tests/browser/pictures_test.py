# SPDX-License-Identifier: BSD-3-Clause
"""pictures_test.py WARREN EXAMPLES: pages of worlds as people use them, in a headless Chromium: layers, mouse, fingers, keys,
sliders, light and dark, phone and paper."""
import subprocess
import sys
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import BrowserTest

WARREN, WORLDS = sys.argv.pop(1), sys.argv.pop(1)


class Pictures(BrowserTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        worlds = {'maze.html': ['maze:41x41,seed=3,loops=0.1', '--planner', 'prm', '--pipeline', 'plain'],
                  'car.html': [WORLDS + '/parking.scene', '--seed', '1'],
                  'town.html': [WORLDS + '/town.geojson', '--start', '1.5,1.5', '--goal', '9.5,8.5', '--planner', 'prm', '--samples', '300'],
                  'arm.html': [WORLDS + '/puma.scene', '--optimise'],
                  'still.html': [WORLDS + '/puma.scene', '--optimise', '--show', 'world,path,axes'],
                  'large.html': ['maze:700x700']}
        for name, words in worlds.items():
            subprocess.run([WARREN, 'solve', *words, '--svg', cls.folder.name + '/' + name, '--quiet'], check=True)

    def shown(self, name):
        self.open(name)
        self.frames()
        return self.browser.find_element(By.ID, 'marks')

    def ink(self, canvas='still'):
        """Of each colour how many pixels, the commonest first."""
        return self.run_script('''
            const canvas = document.getElementById(arguments[0]), copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", {willReadFrequently: true});
            copy.drawImage(canvas, 0, 0);
            const data = copy.getImageData(0, 0, canvas.width, canvas.height).data;
            const count = new Map();
            for (let i = 0; i < data.length; i += 4) { const c = data[i] << 16 | data[i + 1] << 8 | data[i + 2]; count.set(c, (count.get(c) || 0) + 1); }
            return [...count].sort((a, b) => b[1] - a[1]).slice(0, 50)''', canvas)

    def scale(self):
        return self.run_script('return view.scale')

    def whole(self):
        """The scale at which all is seen in the window as it is."""
        return self.run_script('return fitted()')

    def told(self):
        return self.browser.find_element(By.ID, 'readout').text

    def test_every_page_shows_its_world(self):
        for name in ('maze.html', 'car.html', 'town.html', 'arm.html', 'large.html'):
            with self.subTest(name):
                self.shown(name)
                self.assertGreater(len(self.ink()), 1)
                self.assertGreater(len(self.ink('marks')), 3)
                self.assertTrue(self.browser.find_element(By.ID, 'title').text)
                self.assertGreaterEqual(len(self.browser.find_elements(By.CSS_SELECTOR, '#layers .layer')), 4)

    def test_layers_go_and_come_back(self):
        self.shown('maze.html')
        before = self.ink()
        box = self.browser.find_element(By.NAME, 'walls')
        box.click()
        self.frames()
        self.assertNotEqual(self.ink(), before)
        box.click()
        self.frames()
        self.assertEqual(self.ink(), before)

    def test_the_wheel_zooms_at_the_pointer_within_limits(self):
        marks = self.shown('maze.html')
        home = self.scale()
        self.assertAlmostEqual(home, self.whole())
        under = 'const b = marks.getBoundingClientRect(); return [worldX(400 - b.x), worldY(300 - b.y)]'
        before = self.run_script(under)
        turn = 'marks.dispatchEvent(new WheelEvent("wheel", {deltaY: arguments[0], cancelable: true, clientX: 400, clientY: 300}))'
        self.run_script(turn, -400)
        self.assertGreater(self.scale(), 1.5 * home)
        for was, now in zip(before, self.run_script(under)):
            self.assertAlmostEqual(was, now, 6)
        for amount in (-1e5, 1e5):
            for _ in range(3):
                self.run_script(turn, amount)
            self.assertTrue(home / 5 < self.scale() < home * 5000)
        marks.send_keys('0')
        self.assertAlmostEqual(self.scale(), self.whole())

    def test_a_drag_moves_and_ends_with_a_cancel(self):
        marks = self.shown('maze.html')
        where = 'return [view.x, view.y]'
        home = self.run_script(where)
        self.actions().move_to_element(marks).click_and_hold().move_by_offset(60, 40).release().perform()
        moved = self.run_script(where)
        self.assertNotEqual(home, moved)
        self.actions().move_by_offset(30, 30).perform()
        self.assertEqual(self.run_script(where), moved, 'the button is up')
        self.run_script('''marks.setPointerCapture = () => {};
            const say = (kind, x) => marks.dispatchEvent(new PointerEvent(kind, {pointerId: 7, clientX: x, clientY: 300}));
            say("pointerdown", 300); say("pointercancel", 300); say("pointermove", 400)''')
        self.assertEqual(self.run_script(where), moved, 'the pointer was taken away')

    def test_two_fingers_zoom(self):
        self.shown('town.html')
        before = self.scale()
        self.touch('touchStart', (400, 300), (500, 300))
        for way in (20, 40, 80):
            self.touch('touchMove', (400 - way, 300), (500 + way, 300))
        self.touch('touchEnd')
        self.assertGreater(self.scale(), 1.5 * before)
        self.assertEqual(self.run_script('return held.size'), 0)

    def test_keys_do_what_buttons_do(self):
        marks = self.shown('maze.html')
        home = self.scale()
        marks.send_keys('+')
        closer = self.scale()
        self.assertGreater(closer, home)
        marks.send_keys('-')
        self.assertAlmostEqual(self.scale(), home)
        self.browser.find_element(By.ID, 'closer').click()
        self.assertAlmostEqual(self.scale(), closer)
        x = self.run_script('return view.x')
        marks.send_keys(Keys.ARROW_RIGHT)
        self.assertGreater(self.run_script('return view.x'), x)
        self.browser.find_element(By.ID, 'whole').click()
        self.assertAlmostEqual(self.scale(), self.whole())

    def test_the_whole_stays_in_a_window_of_another_size_until_somebody_moves(self):
        marks = self.shown('maze.html')
        for width, height in ((900, 700), (1100, 500)):
            before = self.scale()
            self.browser.set_window_size(width, height)
            self.wait(lambda: self.scale() != before)
            self.assertAlmostEqual(self.scale(), self.whole())
        marks.send_keys('+')
        closer = self.scale()
        self.browser.set_window_size(900, 700)
        self.wait(lambda: self.run_script('return innerHeight') > 500)
        self.frames()
        self.assertEqual(self.scale(), closer)

    def at(self, x, y):
        """Points at a place of the world."""
        px, py = self.run_script('const b = marks.getBoundingClientRect(); return [b.x + screenX(arguments[0] - picture.origin[0]), b.y + screenY(arguments[1] - picture.origin[1])]', x, y)
        self.browser.execute_cdp_cmd('Input.dispatchMouseEvent', {'type': 'mouseMoved', 'x': px, 'y': py})
        self.frames()

    def test_the_pointer_is_told_place_and_clearance(self):
        self.shown('maze.html')
        for _ in range(4):
            self.browser.find_element(By.ID, 'closer').click()
        x, y = self.run_script('return [Math.round(view.x + picture.origin[0]), Math.round(view.y + picture.origin[1])]')
        self.at(x, y)  # the middle of a cell: walls are half a cell away
        self.assertRegex(self.told(), r'clearance 0\.5')
        self.assertIn(f'x {x}', self.told())

    def test_milestones_and_edges_say_who_they_are(self):
        self.shown('town.html')
        x, y = self.run_script('const s = layerOf("milestones").xy; return [s[0] + picture.origin[0], s[1] + picture.origin[1]]')
        self.at(x, y)
        self.assertRegex(self.told(), r'milestone \d+')
        self.run_script('layerOf("milestones").shown = false')
        middle = self.run_script('const s = layerOf("edges").segments; return [(s[0] + s[2]) / 2 + picture.origin[0], (s[1] + s[3]) / 2 + picture.origin[1]]')
        self.at(*middle)
        self.assertRegex(self.told(), r'edge \d+ to \d+, \d')

    def test_inside_a_polygon_is_said(self):
        self.shown('town.html')
        inside = self.run_script('''const l = layerOf("polygons"), n = l.first[1]; let x = 0, y = 0;
            for (let i = 0; i < 3; ++i) { x += l.xy[2 * i] / 3; y += l.xy[2 * i + 1] / 3; } return [x + picture.origin[0], y + picture.origin[1], isInside(l, x, y)]''')
        self.at(*inside[:2])
        self.assertEqual('inside' in self.told(), inside[2])

    def test_lengths_are_measured(self):
        marks = self.shown('maze.html')
        marks.send_keys('m')
        for dx in (0, 100):
            self.actions().move_to_element_with_offset(marks, dx, 0).click().perform()
        self.assertRegex(self.told(), r'measured \d')
        length = self.run_script('return measuredLength()')
        self.assertAlmostEqual(length, 100 / self.scale(), 3)
        marks.send_keys(Keys.ESCAPE)
        self.assertEqual(self.run_script('return measured.length'), 0)

    def slide(self, name, value):
        self.run_script('const s = document.getElementById(arguments[0]); s.value = arguments[1]; s.dispatchEvent(new Event("input"))', name, value)
        self.frames()

    def test_the_search_grows_with_its_slider(self):
        self.shown('maze.html')
        reached = []
        for value in (100, 500, 1000):
            self.slide('wave', value)
            reached.append(self.run_script('return wave.share >= 1 ? picture.graph.byCost.length : picture.graph.byCost.filter(c => c <= wave.share * picture.graph.byCost.at(-1)).length'))
        self.assertEqual(reached, sorted(set(reached)))
        self.assertIn('all', self.browser.find_element(By.ID, 'reached').text)

    def test_the_body_goes_from_start_to_goal(self):
        self.shown('car.html')
        ends = []
        for value in (0, 1000):
            self.slide('motion', value)
            ends.append(self.run_script('return poseAt(motion.share).slice(0, 2)'))
        asked = self.run_script('return [picture.ends.start, picture.ends.goal].map(p => [p.x, p.y])')
        for end, at in zip(ends, asked):
            for a, b in zip(end, at):
                self.assertAlmostEqual(a, b, 5)
        self.assertIn('heading', self.browser.find_element(By.ID, 'moment').text)

    def test_an_arm_moves_in_all_its_views(self):
        self.shown('arm.html')
        seen = [self.ink('marks')]
        for value in (300, 700):
            self.slide('motion', value)
            seen.append(self.ink('marks'))
        self.assertEqual(len({str(ink) for ink in seen}), 3)
        ends = self.run_script('return [0, 1].map(share => [...spineAt(share)])')
        spines = self.run_script('return [...arm.spines]')
        self.assertEqual(ends, [spines[:len(ends[0])], spines[-len(ends[0]):]])
        self.assertIn('70 %', self.browser.find_element(By.ID, 'moment').text)

    def test_the_perspective_turns_and_the_nearest_solid_is_seen(self):
        self.shown('arm.html')
        before = self.ink('marks')
        self.slide('turn', 90)
        self.assertNotEqual(self.ink('marks'), before)
        depths = self.run_script('''const eye = new Eye(64), ball = (x, r) => ({a: [x, 0, 0], b: [x, 0, 0], r, color: [9, 9, 9]}), to = eye.at.map(v => 0.3 * v);
            eye.draw(ball(0, 0.2 * arm.reach)); const far = eye.depth[32 * 64 + 32];
            eye.draw({a: to, b: to, r: 0.2 * arm.reach, color: [9, 9, 9]}); return [far, eye.depth[32 * 64 + 32], eye.depth[0], arm.reach]''')
        self.assertAlmostEqual(depths[0], 3.0 * depths[3], 2)
        self.assertAlmostEqual(depths[1], 0.7 * 3.2 * depths[3] - 0.2 * depths[3], 2)

    def test_the_roadmap_of_an_arm_is_seen_in_perspective(self):
        kept, page = self.folder.name + '/arm.roadmap', self.folder.name + '/arm-roadmap.html'
        subprocess.run([WARREN, 'build', WORLDS + '/puma.scene', '--samples', '100', '-o', kept], check=True, capture_output=True)
        subprocess.run([WARREN, 'render', kept, '-o', page], check=True, capture_output=True)
        self.open('arm-roadmap.html')
        self.async_script("""const layer = layers.find(one => one.id === "perspective"), wait = () => layer.image?.complete ? done() : requestAnimationFrame(wait); wait()""")
        self.frames()
        with_it = self.ink()
        self.browser.find_element(By.NAME, 'perspective').click()
        self.frames()
        self.assertNotEqual(self.ink(), with_it)

    def test_in_views_beside_each_other_places_are_the_views_own(self):
        self.shown('arm.html')
        box, origin = self.run_script('const p = picture.panels[0]; return [p.box, p.origin]')
        self.at(*[(box[i] + box[i + 2]) / 2 + o for i, o in enumerate(self.run_script('return picture.origin'))])
        self.assertRegex(self.told(), r'^x -?[\d.]+, z -?[\d.]+$')

    def test_play_moves_and_pauses(self):
        self.shown('car.html')
        self.browser.find_element(By.ID, 'play').click()
        self.async_script('const wait = () => motion.share > 0.01 ? done() : requestAnimationFrame(wait); wait()')
        self.browser.find_element(By.ID, 'play').click()
        share = self.run_script('return motion.share')
        self.frames()
        self.assertEqual(self.run_script('return motion.share'), share)

    def test_dark_follows_the_system_and_the_button(self):
        self.media(color_scheme='dark')
        self.shown('maze.html')
        self.assertTrue(self.run_script('return isDark()'))
        paper = self.ink()[0][0]
        self.assertLess(paper, 0x404040)
        self.browser.find_element(By.ID, 'dark').click()
        self.frames()
        self.assertGreater(self.ink()[0][0], 0xf0f0f0)

    def test_a_perspective_without_its_body_has_the_pages_paper(self):
        self.media(color_scheme='dark')
        self.shown('still.html')
        colours = dict(self.ink())
        self.assertLess(colours.get(0, 0), 1000, 'black is no paper here')
        self.assertGreater(colours.get(0x0f172a, 0), 100000)

    def test_a_phone_sees_all_of_it(self):
        self.browser.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {'width': 390, 'height': 780, 'deviceScaleFactor': 2, 'mobile': True})
        try:
            self.shown('maze.html')
            self.assertLessEqual(self.run_script('return document.documentElement.scrollWidth'), 390)
            self.assertGreater(self.run_script('return stage.clientHeight'), 250)
            self.assertGreater(len(self.ink()), 1)
        finally:
            self.browser.execute_cdp_cmd('Emulation.clearDeviceMetricsOverride', {})

    def test_paper_is_light_and_whole(self):
        self.media(color_scheme='dark')
        self.shown('maze.html')
        self.assertGreater(len(self.browser.execute_cdp_cmd('Page.printToPDF', {'printBackground': True})['data']), 5000)
        self.frames()
        self.assertTrue(self.run_script('return isDark()'), 'the screen is as it was')

    def test_nothing_is_loaded(self):
        self.shown('town.html')
        self.assertEqual(self.run_script('return performance.getEntriesByType("resource").filter(e => !e.name.startsWith("data:")).length'), 0)


class Reports(BrowserTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        subprocess.run([WARREN, 'compare', 'maze:9x9', '--planners', 'prm,lazy-prm', '--sampler', 'uniform', '--samples',
                        '100,300,600', '--seeds', '4', '--html', cls.folder.name + '/compare.html', '--quiet'], check=True)
        subprocess.run([WARREN, 'scale', '--sizes', '20,40', '--repeats', '1', '--html', cls.folder.name + '/scale.html', '--quiet'], check=True)

    def column(self, index):
        return [row.find_elements(By.TAG_NAME, 'td')[index].text for row in self.browser.find_elements(By.CSS_SELECTOR, 'tbody tr')]

    def test_a_click_sorts_and_another_turns_it_round(self):
        self.open('compare.html')
        heads = self.browser.find_elements(By.CSS_SELECTOR, 'th button')
        index = [head.text for head in heads].index('expanded')
        heads[index].click()
        up = [float(text.replace(',', '')) for text in self.column(index)]
        self.assertEqual(up, sorted(up))
        self.assertGreater(len(set(up)), 2)
        heads[index].send_keys(Keys.ENTER)
        down = [float(text.replace(',', '')) for text in self.column(index)]
        self.assertEqual(down, up[::-1] if len(set(up)) == len(up) else sorted(up, reverse=True))

    def test_times_sort_by_their_units(self):
        self.open('scale.html')
        weigh = 'return ["2 us", "1.5 ms", "3 s", "-", "12 of 20", "1 KiB"].map(weight)'
        self.assertEqual(self.run_script(weigh), [2e-6, 0.0015, 3, None, 12, 1024])

    def test_a_mark_tells_what_it_stands_for(self):
        for name in ('compare.html', 'scale.html'):
            with self.subTest(name):
                self.open(name)
                mark = self.browser.find_element(By.CSS_SELECTOR, '.plots [data-tip]')
                self.actions().move_to_element(mark).perform()
                tip = self.browser.find_element(By.ID, 'tip')
                self.assertTrue(tip.is_displayed())
                self.assertRegex(tip.text, r'\d')

    def test_the_table_of_compare_shows_all_columns_in_1200_pixels(self):
        self.browser.set_window_size(1200, 800)
        self.open('compare.html')
        self.assertEqual(self.run_script('const wide = document.querySelector(".wide"); return wide.scrollWidth - wide.clientWidth'), 0)

    def test_heat_maps_have_the_same_colours_on_dark_pages(self):
        subprocess.run([WARREN, 'compare', 'maze:9x9', '--planners', 'prm', '--sampler', 'uniform', '--samples', '100,300',
                        '--neighbours', '4,8', '--seeds', '2', '--html', self.path('heat.html'), '--quiet'], check=True)
        self.media(color_scheme='dark')
        self.open('heat.html')
        filters = self.run_script('return [...document.querySelectorAll(".plots svg")].map(svg => [svg.classList.contains("kept"), getComputedStyle(svg).filter === "none"])')
        self.assertEqual({tuple(one) for one in filters}, {(True, True), (False, False)})

    def test_narrow_pages_do_not_overflow(self):
        self.browser.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {'width': 390, 'height': 780, 'deviceScaleFactor': 2, 'mobile': True})
        try:
            for name in ('compare.html', 'scale.html'):
                self.open(name)
                self.assertLessEqual(self.run_script('return document.documentElement.scrollWidth'), 390)
        finally:
            self.browser.execute_cdp_cmd('Emulation.clearDeviceMetricsOverride', {})


if __name__ == '__main__':
    unittest.main()
