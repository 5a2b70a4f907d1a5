# SPDX-License-Identifier: BSD-3-Clause
"""page_tools_test.py WARREN: what lies around the path on the page of `warren serve`, in a headless Chromium: headings
of bodies that turn and lengths by mouse."""
import math
import os
import sys
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import MapTest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'acceptance'))
from service import Service  # noqa: E402

WARREN = sys.argv.pop(1)
YARD = 'bounds 0 0 100 60\nwall 50 0 50 20\nstart 5 30\ngoal 95 30\n'
PLAIN = 'bounds 0 0 4000000 4000000\nwall 2000000 0 2000000 1000000\nstart 10000 10000\ngoal 3900000 10000\n'
ROUND = ('bounds 0 0 100 60\nrobot polygon ' + ' '.join(f'{2 * math.cos(i * math.pi / 30):.9f} {2 * math.sin(i * math.pi / 30):.9f}' for i in range(60)) +
         '\nstart 10 30 0\ngoal 90 30\n')
DRIVE = 'bounds 0 0 60 40\nrobot car radius 1 turning 5\nstart 10 10 0\ngoal 40 25 3\n'
HALL = 'bounds 0 0 100 60\nrobot polygon -4 -1 4 -1 4 1 -4 1\nstart 10 30 0\ngoal 90 30\n'


class PageTools(MapTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.services = {}
        for name, text in (('yard', YARD), ('hall', HALL), ('plain', PLAIN), ('round', ROUND), ('drive', DRIVE)):
            with open(os.path.join(cls.folder.name, name + '.scene'), 'w', encoding='utf-8') as file:
                file.write(text)
            cls.services[name] = Service(WARREN, os.path.join(cls.folder.name, name + '.scene'), '--writable')

    @classmethod
    def tearDownClass(cls):
        for service in cls.services.values():
            assert service.stop() == 0
        super().tearDownClass()

    def shown(self, name, link=''):
        self.show_map(self.services[name].url + link)
        self.wait_for('Solved')

    def heading(self, end):
        """In degrees."""
        heading = self.run_script('return question[arguments[0] + "Heading"]', end)
        return None if heading is None else math.degrees(heading)

    def wait_for_heading_of_path(self, index, degrees):
        self.wait(lambda: self.run_script('return answer.json && answer.json.verified'))
        self.wait(lambda: abs(math.remainder(self.run_script('return answer.json ? answer.json.path.at(arguments[0])[2] : 100', index) -
                                             math.radians(degrees), 2 * math.pi)) < 1e-9)

    def test_a_dragged_arrow_sets_the_heading(self):
        self.shown('hall')
        self.assertIsNone(self.heading('goal'))
        reach = self.run_script('return handleReach')
        for end, index, (x, y), degrees in (('start', 0, (0, -60), 90), ('goal', -1, (-80, 80), -135)):
            handle = self.browser.find_element(By.CSS_SELECTOR, '.handle.' + end)
            self.actions().click_and_hold(handle).move_by_offset(5, 5).move_by_offset(x - reach - 5, y - 5).release().perform()
            self.assertAlmostEqual(self.heading(end), degrees, delta=2)
            self.wait_for_heading_of_path(index, self.heading(end))
        link = self.run_script('return location.href')
        headings = [self.heading('start'), self.heading('goal')]
        places = self.run_script('return [question.start, question.goal]')
        self.assertEqual(places, [{'x': 10, 'y': 30}, {'x': 90, 'y': 30}])  # it was the arrow that was dragged
        self.show_map(link)
        self.wait_for('Solved')
        self.assertEqual([self.heading('start'), self.heading('goal')], headings)

    def test_a_finger_turns_the_arrow(self):
        self.shown('hall')
        box = self.run_script('const b = handles.goal.getElement().getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]')
        reach = self.run_script('return handleReach')
        self.touch('touchStart', box)
        self.touch('touchMove', (box[0] - reach / 2, box[1] - reach))
        self.touch('touchMove', (box[0] - reach, box[1] - 2 * reach))
        self.wait(lambda: self.heading('goal') is not None and abs(self.heading('goal') - 90) < 2)
        self.touch('touchEnd')
        self.wait_for_heading_of_path(-1, self.heading('goal'))

    def test_keys_turn_the_mark(self):
        self.shown('hall')
        mark = self.browser.find_element(By.CSS_SELECTOR, '.mark.start')
        mark.send_keys('[')
        self.assertAlmostEqual(self.heading('start'), 5)
        mark.send_keys(']' + ']')
        self.assertAlmostEqual(self.heading('start'), -5)
        mark.send_keys(Keys.SHIFT + '[' + Keys.NULL)
        self.assertAlmostEqual(self.heading('start'), 40)
        self.wait_for_heading_of_path(0, 40)
        self.assertIn('heading 40 degrees', mark.get_attribute('aria-label'))
        self.assertEqual(self.by_id('start').get_attribute('value'), '10, 30, 40')

    def test_a_car_is_drawn_as_it_drives(self):
        self.shown('yard')  # any page has the function
        turns = self.run_script('''world.robot = 'car radius 0.3';
            return asDriven([[0, 0, 0], [1, 1, Math.PI / 2], [1, 3, Math.PI / 2]]).map(p => [Math.hypot(p[0], p[1] - 1), p[2]])''')
        self.assertEqual(len(turns), 20)
        for off, _ in turns[:-1]:
            self.assertAlmostEqual(off, 1, 12)
        for (_, before), (_, after) in zip(turns, turns[1:]):
            self.assertLess(after - before, math.radians(5) + 1e-9)

    def test_the_line_of_a_car_bends_as_it_drives(self):
        self.shown('drive')
        for goal in (None, 100):
            if goal is not None:
                self.run_script('setHeading("goal", arguments[0])', goal)
                self.wait_for_heading_of_path(-1, goal)
            path, length, line = self.run_script('''const line = pathLine.line.getLatLngs().flat();
                return [answer.json.path, answer.json.length, line.map(p => [p.lng, p.lat])]''')
            chords = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(line, line[1:])]
            driven = sum(math.hypot(*chord) for chord in chords)
            self.assertLessEqual(driven, length + 1e-9)
            self.assertGreater(driven, 0.9995 * length)  # straight from pose to pose it is a tenth less
            for (ax, ay), (bx, by) in zip(chords, chords[1:]):
                self.assertLess(abs(math.atan2(ax * by - ay * bx, ax * bx + ay * by)), math.radians(5) + 1e-6)
            self.assertEqual((line[0], line[-1]), (path[0][:2], path[-1][:2]))

    def test_bodies_that_do_not_turn_have_no_arrow(self):
        self.shown('yard')
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, '.handle'), [])

    def test_lengths_by_mouse_set_no_ends(self):
        self.shown('yard')
        ends = self.run_script('return JSON.stringify([question.start, question.goal])')
        self.by_id('map').send_keys('m')
        self.click_at(20, 10)
        self.click_at(50, 50)
        self.wait_for('Length so far')
        points = self.run_script('return measuring.points.map(p => [p.x, p.y])')
        self.assertEqual(len(points), 2)
        self.assertAlmostEqual(float(self.run_script('return document.querySelector(".measured").textContent')), math.dist(*points), places=2)
        self.assertAlmostEqual(math.dist(*points), 50, delta=1)
        zoom = self.run_script('return map.getZoom()')
        self.at(80, 50).double_click().perform()
        self.wait_for('Measured: ')
        self.assertEqual(self.run_script('return [measuring.on, measuring.points.length, map.getZoom()]'), [False, 3, zoom])
        self.assertEqual(self.run_script('return JSON.stringify([question.start, question.goal])'), ends)
        self.by_id('map').send_keys(Keys.ESCAPE)
        self.wait(lambda: self.browser.find_elements(By.CSS_SELECTOR, '.measured') == [])  # it fades
        self.click_at(80, 50)
        self.assertNotEqual(self.run_script('return JSON.stringify([question.start, question.goal])'), ends)

    def test_lengths_by_keys_and_beside_other_tools(self):
        self.shown('yard')
        self.run_script('byId("drawing").open = true')
        self.by_id('draw-wall').click()
        self.by_id('measure').click()
        self.assertIsNone(self.run_script('return drawing.tool'))
        self.by_id('map').send_keys(Keys.ENTER)
        self.run_script('map.panBy([100, 0], {animate: false})')
        self.by_id('map').send_keys(Keys.ENTER)
        self.wait_for('Length so far')
        self.by_id('map').send_keys(Keys.ESCAPE)
        self.assertEqual(self.run_script('return measuring.points.length'), 2)
        self.by_id('measure').click()
        self.assertEqual(self.run_script('return measuring.points.length'), 0)
        self.by_id('draw-wall').click()
        self.assertFalse(self.run_script('return measuring.on'))

    def test_clearance_along_the_path_is_shown_place_by_place(self):
        self.shown('yard')
        self.press('clearance-summary')
        self.wait(lambda: self.by_id('clearance-text').text.count(',') > 0)
        least = self.run_script('return answer.json.min_clearance')
        self.assertAlmostEqual(self.run_script('return profile.places[Number(byId("clearance-at").value)].clearance'), least, delta=0.1)
        self.assertIn('least', self.by_id('clearance-text').text)
        slider = self.by_id('clearance-at')
        slider.send_keys(Keys.HOME)
        at_start = self.run_script('const p = profile.dot.getLatLng(); return [p.lng, p.lat]')
        self.assertEqual(at_start, [5, 30])
        self.assertTrue(self.by_id('clearance-text').text.startswith('5 after 0'))
        slider.send_keys(Keys.ARROW_RIGHT)
        self.assertIn(' after ', slider.get_attribute('aria-valuetext'))
        self.assertNotEqual(self.run_script('const p = profile.dot.getLatLng(); return [p.lng, p.lat]'), at_start)
        self.actions().move_to_element(self.by_id('clearance-chart')).perform()
        self.wait(lambda: abs(self.run_script('return profile.dot.getLatLng().lng') - 50) < 5)
        before = self.run_script('return profile.id')
        self.run_script('setEnd("goal", {x: 90, y: 50})')
        self.wait(lambda: self.run_script('return profile.id !== null && profile.places.length > 0') and self.run_script('return profile.id') != before)
        self.press('clear')
        self.assertFalse(slider.is_displayed())

    def forget_paths(self, times):
        """So many looks at paths find none, and questions are counted."""
        self.run_script('''
            window.forgets = arguments[0];
            window.questions = 0;
            const asks = fetch;
            fetch = async (place, ...more) => {
              if (place === "api/query") ++questions;
              if (!place.startsWith("api/path/") || forgets-- <= 0) return asks(place, ...more);
              return new Response(JSON.stringify({error: {code: "not_found", where: "path", message: "forgotten"}}), {status: 404});
            };
            pathLine.whole = false;  // as one of many points, of which a part is seen
            map.fire("moveend");''', times)

    def test_a_path_that_the_service_let_go_is_asked_for_anew(self):
        self.shown('yard')
        self.press('clearance-summary')
        self.wait(lambda: self.by_id('clearance-text').text.count(',') > 0)
        self.forget_paths(1)
        self.wait(lambda: self.run_script('return questions') == 1 and self.by_id('clearance-text').text.count(',') > 0)
        self.assertIn('Solved', self.status())
        self.shown('hall', '#layers=sweep')
        self.wait(lambda: self.run_script('return sweep.bodies !== null'))
        self.forget_paths(2)  # the look at the path and that at its sweep
        self.wait(lambda: self.run_script('return questions') == 1)
        self.wait(lambda: self.run_script('return sweep.bodies !== null'))
        self.assertIn('Solved', self.status())

    def test_a_path_that_is_never_kept_is_said_to_be_so(self):
        self.shown('hall', '#layers=sweep')
        self.forget_paths(1000)
        self.wait_for('does not keep this path')
        self.run_script('map.fire("moveend")')
        self.frames()
        self.assertEqual(self.run_script('return questions'), 1)

    def save_of_many_points(self, times):
        """Answers list no points, as those of long paths; so many looks find no path. What is saved is `saved`."""
        self.run_script('''
            window.saved = [];
            window.questions = 0;
            window.forgets = arguments[0];
            URL.createObjectURL = blob => { blob.text().then(text => saved.push(text)); return "about:blank#"; };
            HTMLAnchorElement.prototype.click = () => {};
            const asks = fetch;
            fetch = async (place, ...more) => {
              if (place === "api/query") {
                ++questions;
                const reply = await asks(place, ...more), json = await reply.json();
                return new Response(JSON.stringify({...json, path: [], path_points: json.path.length}), {status: reply.status, headers: reply.headers});
              }
              if (!place.startsWith("api/path/") || forgets-- <= 0) return asks(place, ...more);
              return new Response(JSON.stringify({error: {code: "not_found", where: "path", message: "forgotten"}}), {status: 404});
            };
            ask();''', times)
        self.wait(lambda: self.run_script('return questions === 1 && answer.json !== null && answer.json.path.length === 0 && pathLine.line !== null'))

    def saved(self):
        return self.run_script('return saved')

    def test_a_path_that_the_service_let_go_is_asked_for_anew_and_saved(self):
        for name, words in (('save-geojson', '"LineString"'), ('save-csv', 's,x,y')):
            self.shown('yard')
            path = self.run_script('return answer.json.path')
            self.save_of_many_points(0)
            self.run_script('forgets = 1')
            self.press(name)
            self.wait(lambda: len(self.saved()) == 1)
            self.assertIn(words, self.saved()[0])
            for x, y in path:
                self.assertIn(f'{x:g},{y:g}' if x == int(x) and y == int(y) else f'{x!r},{y!r}', self.saved()[0])
            self.assertEqual(self.run_script('return questions'), 2)
            self.assertIn('Solved', self.status())
            self.press(name)
            self.wait(lambda: len(self.saved()) == 2)
            self.assertEqual(self.saved()[0], self.saved()[1])
            self.assertEqual(self.run_script('return questions'), 2)
            self.run_script('forgets = 1')  # it is let go once more
            self.press(name)
            self.wait(lambda: len(self.saved()) == 3)
            self.assertEqual(self.run_script('return questions'), 3)

    def test_a_path_that_is_never_kept_is_said_not_to_be_saved(self):
        self.shown('yard')
        self.save_of_many_points(0)
        self.run_script('forgets = 1000')
        for _ in range(2):
            self.press('save-csv')
            self.wait_for("can't be saved")
            self.run_script('say("")')
        self.assertEqual(self.run_script('return questions'), 2)
        self.assertEqual(self.saved(), [])

    def test_a_path_of_too_many_points_is_said_to_be_written_by_the_program(self):
        self.shown('yard')
        self.save_of_many_points(0)
        self.run_script('''
            fetch = async () => new Response(JSON.stringify({error: {code: "path_too_long", where: "query", message: "bbox and z"}}), {status: 413});''')
        self.press('save-geojson')
        self.wait_for('--path FILE')

    def test_another_question_saves_nothing_of_the_last_one(self):
        self.shown('yard')
        self.save_of_many_points(0)
        self.run_script('forgets = 1')
        self.press('save-csv')
        self.wait(lambda: self.run_script('return lost.saving !== null || saved.length > 0') or self.run_script('return questions') > 1)
        self.run_script('setEnd("goal", {x: 20, y: 10})')
        self.wait(lambda: self.run_script('return !asking && answer.json !== null && answer.json.goal[0] === 20'))
        self.frames()
        for text in self.saved():  # it may have come before the other question
            self.assertIn('95,30', text)
        self.assertIsNone(self.run_script('return lost.saving'))

    def test_figures_are_in_groups_of_three_as_in_the_program(self):
        self.shown('plain', '#layers=clearance')
        self.wait_for('Solved: 4 ')
        figures = self.by_id('figures').text
        self.assertRegex(figures, 'length 4 [0-9]{3} [0-9]{3}\n')
        self.wait(lambda: 'and more' in self.by_id('layer-clearance-legend').text)
        self.assertIn('1 400 000 and more', self.by_id('layer-clearance-legend').text)
        self.assertEqual(self.by_id('goal').get_attribute('value'), '3900000, 10000')  # as it would be typed
        told = self.run_script('''
            return [0, 0.1234567, 999, 1000, -12345.678, 999999.7, 1234567.89, 1e15].map(shown).concat([0.5, 0.9996, 99.96, 999.6, 1234567].map(asTime));''')
        self.assertEqual([text.replace('\u00a0', ' ') for text in told],
                         ['0', '0.123457', '999', '1 000', '-12 345.7', '1 000 000', '1 234 568', '1 000 000 000 000 000',
                          '500 µs', '1.00 ms', '100 ms', '1.00 s', '1 235 s'])

    def box(self, name):
        return self.run_script('const b = arguments[0].getBoundingClientRect(); return [b.left, b.top, b.right, b.bottom]',
                               self.browser.find_element(By.CSS_SELECTOR, name))

    def test_the_picture_is_seen_in_small_windows(self):
        for width, height in ((390, 780), (320, 480), (200, 200), (120, 90), (300, 100), (700, 150), (1200, 120)):
            for name in ('hall', 'round'):
                with self.subTest(width=width, height=height, name=name):
                    self.browser.execute_cdp_cmd('Emulation.setDeviceMetricsOverride',
                                                 {'width': width, 'height': height, 'deviceScaleFactor': 1, 'mobile': False})
                    self.shown(name)
                    left, top, right, bottom = self.box('main')
                    self.assertGreaterEqual(bottom - top, 0.4 * height)
                    self.assertLessEqual(bottom, height)
                    self.assertGreaterEqual(top, self.box('header')[3])
                    beside = self.box('aside')
                    self.assertTrue(beside[0] >= right or beside[1] >= bottom)
                    self.assertLessEqual(beside[3], height)
                    self.assertEqual(self.run_script('const s = map.getSize(), b = map.getContainer(); return [s.x - b.clientWidth, s.y - b.clientHeight]'), [0, 0])
                    self.assertLessEqual(self.run_script('return document.documentElement.scrollWidth'), width)
        self.browser.execute_cdp_cmd('Emulation.clearDeviceMetricsOverride', {})

    def test_the_place_of_the_pointer_is_not_read_out(self):
        self.shown('yard')
        self.assertEqual(self.by_id('readout').get_attribute('aria-live'), 'off')
        self.at(20, 10).perform()
        self.assertTrue(self.by_id('readout').text.startswith('20'))


if __name__ == '__main__':
    unittest.main()
