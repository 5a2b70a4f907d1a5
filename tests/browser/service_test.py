# SPDX-License-Identifier: BSD-3-Clause
"""service_test.py WARREN EXAMPLES: the page of `warren serve` as people use it, in a headless Chromium: clicks, drags, keys, the
link, zooms, dark, phone. A word on the console, of the page's policy too, fails a test."""
import json
import math
import os
import subprocess
import sys
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import MapTest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'acceptance'))
from service import Service  # noqa: E402

WARREN, WORLDS = sys.argv.pop(1), sys.argv.pop(1)
MAZE = 'maze:300x300,seed=3,loops=0.1'


def length_of(path):
    return sum(math.dist(a, b) for a, b in zip(path, path[1:]))


class ServicePage(MapTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name in ('block.scene', '<img src=x onerror=alert(1)>.scene'):
            with open(os.path.join(cls.folder.name, name), 'w', encoding='utf-8') as file:
                file.write('bounds 0 0 10 10\npolygon 4 4 6 4 6 6 4 6\nstart 4.2 5\ngoal 9 9\n')
        with open(os.path.join(cls.folder.name, 'closed.scene'), 'w', encoding='utf-8') as file:
            file.write('bounds 0 0 100 60\nwall 50 0 50 29\nwall 50 31 50 60\nrobot disc 2\nstart 5 30\ngoal 95 30\n')
        cls.closed = Service(WARREN, os.path.join(cls.folder.name, 'closed.scene'))
        cls.maze = Service(WARREN, MAZE)
        cls.town = Service(WARREN, WORLDS + '/town.geojson')

    @classmethod
    def tearDownClass(cls):
        for service in (cls.maze, cls.town, cls.closed):
            assert service.stop() == 0
        super().tearDownClass()

    def shown(self, service, link=''):
        self.show_map(service.url + link)

    def drawn(self):
        """The path as the page draws it."""
        return self.run_script('return pathLine.line ? pathLine.line.getLatLngs().flat().map(p => [p.lng, p.lat]) : []')

    def solved(self, *words):
        text = subprocess.run([WARREN, 'solve', *words, '--json', '-'], capture_output=True, text=True, check=True).stdout
        return json.loads(text)

    def end_of(self, name):
        return self.run_script('return [question[arguments[0]].x, question[arguments[0]].y]', name)

    def test_two_clicks_draw_the_path_that_solve_finds(self):
        self.shown(self.maze)
        self.wait_for('Solved')  # between the world's own ends
        self.by_id('clear').click()
        self.wait_for('Click where to start')
        self.click_at(40, 260)
        self.wait_for('Click where to go')
        self.click_at(250, 30)
        self.wait_for('Solved')
        ends = [','.join(map(repr, self.end_of(name))) for name in ('start', 'goal')]
        expected = self.solved(MAZE, '--start', ends[0], '--goal', ends[1])
        self.assertEqual(length_of(self.drawn()), expected['length'])  # of ways of one length, a roadmap may take another
        self.assertEqual(self.drawn()[-1], expected['goal'])
        self.assertIn('verified', self.by_id('figures').text)
        self.assertIn('work', self.by_id('times').text)

    def test_a_world_fills_its_window_between_axes(self):
        for size in ((1200, 800), (500, 850)):
            self.browser.set_window_size(*size)
            for service, unit in ((self.maze, ' cells'), (self.town, '')):
                self.shown(service)
                slack = self.run_script('''const low = map.latLngToContainerPoint(map.whole.getSouthWest()), high = map.latLngToContainerPoint(map.whole.getNorthEast());
                    return [map.getSize().x - high.x + low.x, map.getSize().y - low.y + high.y]''')
                self.assertGreater(min(slack), 0)
                self.assertLess(min(slack), 60)
                bar = self.browser.find_element(By.CSS_SELECTOR, '.leaflet-control-scale-line').text
                self.assertRegex(bar, r'^(1|2|5)0*' + unit + '$' if unit else r'^[0-9.]+$')
        self.browser.set_window_size(1200, 800)
        self.shown(self.maze)
        for axis in 'xy':
            ticks = self.run_script('''return [...document.querySelectorAll(".axes ." + arguments[0])].map(tick => {
                const box = tick.getBoundingClientRect(), all = map.getContainer().getBoundingClientRect();
                const at = map.containerPointToLatLng([(box.left + box.right) / 2 - all.left, (box.top + box.bottom) / 2 - all.top]);
                return [Number(tick.textContent), arguments[0] === "x" ? at.lng : at.lat];
            })''', axis)
            self.assertGreater(len(ticks), 4)
            for said, is_at in ticks:
                self.assertAlmostEqual(said, is_at, delta=1)

    def test_shift_click_moves_the_start(self):
        self.shown(self.maze, '#start=1,1&goal=300,300')
        self.wait_for('Solved')
        goal = self.end_of('goal')
        self.at(100, 200).key_down(Keys.SHIFT).click().key_up(Keys.SHIFT).perform()
        self.wait(lambda: abs(self.end_of('start')[0] - 100) < 3)
        self.assertEqual(self.end_of('goal'), goal)

    def test_better_paths_are_drawn_as_they_come_and_shown_again_by_the_slider(self):
        self.shown(self.town, '#start=1.5,1.5&goal=9.5,8.5&planner=rrt-star')
        self.wait(lambda: self.run_script('return better.ways.length') > 0)
        self.wait_for('Solved')
        ways = self.run_script('return better.ways.length')
        slider = self.by_id('better-at')
        self.assertTrue(slider.is_displayed())
        self.assertEqual(slider.get_attribute('value'), str(ways))
        self.assertIn("own path", self.by_id('better-text').text)
        slider.send_keys(Keys.HOME)
        self.wait(lambda: 'Length' in self.by_id('better-text').text)
        first = self.run_script('return better.lines.getLayers()[0].getLatLngs().flat().map(p => [p.lng, p.lat])')
        self.assertAlmostEqual(length_of(first), self.run_script('return better.ways[0].length'), places=6)
        self.assertGreaterEqual(length_of(first), length_of(self.drawn()) - 1e-9)
        self.at(3, 3).click().perform()  # another question ends this one
        self.wait(lambda: not slider.is_displayed())

    def test_a_field_that_a_proxy_leaves_out_hides_no_path(self):
        self.shown(self.town, '#start=1.5,1.5&goal=9.5,8.5')
        self.wait_for('Solved')
        before = self.drawn()
        self.assertGreater(len(before), 1)
        self.run_script('''const whole = window.fetch;
            window.fetch = async (...words) => {
                const reply = await whole(...words), fields = new Headers(reply.headers);
                fields.delete("Warren-Path");
                return new Response(reply.body, {status: reply.status, headers: fields});
            };
            ask();''')
        self.wait_for('leaves out the field Warren-Path')
        self.assertEqual(self.drawn(), before)

    def test_no_path_says_why_and_the_body_stands_at_its_ends(self):
        self.shown(self.closed, '#start=5,30&goal=95,30&planner=prm')
        self.wait_for('No path was found')
        self.wait(lambda: 'gap' in self.by_id('why').text)
        self.assertIn('--samples', self.by_id('why').text)
        disc = self.run_script('const disc = endBodies.start.getLayers()[0]; return [disc.getLatLng().lng, disc.getLatLng().lat, disc.getRadius()]')
        self.assertEqual(disc, [5, 30, 2])
        self.shown(self.closed, '#start=5,30&goal=40,30&planner=prm')
        self.wait_for('Solved')
        self.assertFalse(self.by_id('why').is_displayed())

    def write(self, name, text):
        field = self.by_id(name)
        field.clear()
        field.send_keys(text + Keys.ENTER)

    def test_robot_and_clearance_are_asked_and_drawn(self):
        self.shown(self.closed, '#start=5,30&goal=95,30')
        self.wait(lambda: 'path' in self.by_id('status').text)
        self.assertEqual(self.by_id('robot').get_attribute('placeholder'), 'disc 2')
        self.write('robot', 'disc 0.5')
        self.wait_for('Solved')
        radius = 'return endBodies.goal.getLayers()[0].getRadius()'
        self.assertEqual(self.run_script(radius), 0.5)
        self.write('clearance-asked', '0.6')
        self.wait_for('path')
        self.write('clearance-asked', '0.25')
        self.wait(lambda: 'clearance 0.25' in self.by_id('about').text)
        self.wait_for('Solved')
        self.assertGreaterEqual(self.run_script('return answer.json.min_clearance'), 0.25)
        self.write('robot', '[[-2, -0.5], [2, -0.5], [2, 0.5], [-2, 0.5]]')
        self.wait(lambda: self.run_script('return turns()'))
        self.wait_for('Solved')
        self.assertEqual(self.run_script('return endBodies.goal.getLayers()[0].getLatLngs()[0].length'), 4)
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, '.handle')), 2)
        self.by_id('copy-command').click()
        self.assertIn("--robot 'polygon -2 -0.5", self.by_id('copied').get_attribute('value'))
        link = self.run_script('return location.href')
        self.browser.get('about:blank')
        self.browser.get(link)
        self.wait_for('Solved')
        self.assertEqual(self.run_script('return [world.state_size, world.clearance]'), [3, 0.25])

    def test_a_body_that_can_not_be_asked_is_refused_in_words(self):
        self.shown(self.closed, '#start=5,30&goal=40,30')
        self.wait_for('Solved')
        for robot, clearance, said in (('disc', '', 'expected'), ('puma560 radius 1', '', 'arms'), ('disc 1', 'wide', 'clearance'), ('disc 1', '-1', 'clearance')):
            self.write('robot', robot)
            self.write('clearance-asked', clearance)
            self.wait_for(said)
            self.assertEqual(self.drawn(), [])
            self.assertTrue(self.run_script('return endBodies.start === null'))
            self.write('robot', '')
            self.write('clearance-asked', '')
            self.wait_for('Solved')
        self.browser.get_log('browser')  # that the service refused is a word there, too

    def test_a_dragged_mark_takes_the_path_with_it(self):
        self.shown(self.maze, '#start=1,1&goal=300,300')
        self.wait_for('Solved')
        before = self.drawn()
        goal = self.browser.find_element(By.CSS_SELECTOR, '.mark.goal')
        asked = self.run_script('return performance.getEntriesByType("resource").filter(e => e.name.endsWith("/api/query")).length')
        self.actions().click_and_hold(goal).move_by_offset(-60, 40).move_by_offset(-60, 40).perform()
        self.wait(lambda: self.run_script('return performance.getEntriesByType("resource").filter(e => e.name.endsWith("/api/query")).length') > asked)
        self.actions().release().perform()
        self.wait(lambda: self.drawn() and self.drawn() != before and self.drawn()[-1] == self.end_of('goal'))

    def test_the_link_holds_all_of_it(self):
        self.shown(self.town, '#start=1.5,1.5&goal=9.5,8.5&planner=prm&optimise=1&at=5,5,2')
        self.wait_for('Solved')
        link = self.run_script('return location.href')
        state = 'return [JSON.stringify(question), map.getZoom(), byId("planner").value, byId("optimise").checked]'
        before, path = self.run_script(state), self.drawn()
        self.assertEqual(before[1:], [2, 'prm', True])
        self.browser.get('about:blank')
        self.browser.get(link)
        self.wait_for('Solved')
        self.assertEqual(self.run_script(state), before)
        self.assertEqual(self.drawn(), path)

    def test_below_the_path_of_a_proxy_all_is_found(self):
        with Service(WARREN, MAZE, '--public-url', 'https://planner.example.org/robots/') as service:
            self.shown(service, 'robots/#start=1,1&goal=300,300')
            self.wait_for('Solved')
            asked = self.run_script('return performance.getEntriesByType("resource").map(e => e.name).filter(name => name.startsWith("http"))')
            self.assertTrue(any('/tiles/' in name for name in asked) and any('/api/query' in name for name in asked), asked)
            self.assertEqual([name for name in asked if not name.startswith(service.url + 'robots/')], [])

    def test_the_link_follows_long_drags(self):
        self.shown(self.town, '#start=1.5,1.5&goal=9.5,8.5')
        self.wait_for('Solved')
        self.run_script('window.linkCount = 0; const write = history.replaceState.bind(history);'
                        'history.replaceState = (...words) => { ++linkCount; write(...words); };'
                        'for (let i = 0; i < 400; ++i) setEnd("start", {x: 1.5 + i / 1000, y: 1.5});')
        self.assertGreater(self.run_script('return question.start.x'), 1.85)
        self.wait(lambda: self.run_script('return location.hash === linkText()'))
        self.assertLess(self.run_script('return linkCount'), 60)
        self.wait_for('Solved')

    def test_a_link_to_a_view_far_away_shows_the_whole_world(self):
        for at in ('1e308,0,5', '1e12,1e12,3', '-100,5,0'):
            self.shown(self.town, '#start=1.5,1.5&goal=9.5,8.5&at=' + at)
            self.wait_for('Solved')
            self.assertTrue(self.run_script('return map.getBounds().contains(map.whole)'), at)

    def test_the_link_holds_that_there_are_no_ends(self):
        self.shown(self.maze)
        self.wait_for('Solved')  # between the world's own ends
        self.by_id('clear').click()
        self.wait_for('Click where to start')
        link = self.run_script('return location.href')
        self.shown(self.maze, link[link.index('#'):])
        self.assertEqual(self.run_script('return [question.start, question.goal]'), [None, None])
        self.assertIn('Click where to start', self.status())
        self.click_at(40, 260)
        link = self.run_script('return location.href')
        self.shown(self.maze, link[link.index('#'):])
        self.assertEqual(self.run_script('return [question.start !== null, question.goal]'), [True, None])
        self.run_script('location.hash = "#at=150,150,1"')  # one that says nothing of ends
        self.wait_for('Solved')

    def test_the_link_holds_what_is_switched_off(self):
        self.shown(self.maze, '#start=1,1&goal=300,300')
        self.wait_for('Solved')
        for name in ('show-path', 'show-world'):
            self.press(name)
        for link in (self.run_script('return location.hash'), '#start=1,1&goal=300,300&hide=path,world,name'):
            self.shown(self.maze, link)
            self.wait_for('Solved')
            self.assertEqual([self.by_id(name).is_selected() for name in ('show-world', 'show-path')], [False, False])
            self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, '.tiles'), [])
            self.assertFalse(self.run_script('return map.hasLayer(pathLine.line)'))
        self.press('show-world')
        link = self.run_script('return location.hash')
        self.assertIn('hide=path&', link)
        self.shown(self.maze, link)
        self.wait_for('Solved')
        self.assertGreater(len(self.browser.find_elements(By.CSS_SELECTOR, '.tiles img')), 0)
        self.run_script('location.hash = "#start=1,1&goal=300,300"')
        self.wait(lambda: self.run_script('return pathLine.line !== null && map.hasLayer(pathLine.line)'))

    def test_the_command_gives_the_same_path(self):
        self.shown(self.town, '#start=1.5,1.5&goal=9.5,8.5&planner=voronoi')
        self.wait_for('Solved')
        self.assertGreater(len(self.drawn()), 2)
        self.by_id('copy-command').click()
        line = self.by_id('copied').get_attribute('value')
        self.assertTrue(line.startswith('warren solve '), line)
        words = subprocess.run(['sh', '-c', 'printf "%s\\n" ' + line], capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(self.solved(*words[2:])['path'], self.drawn())

    def test_by_keys_alone(self):
        self.shown(self.town)
        self.by_id('start').send_keys('1.5, 1.5', Keys.ENTER)
        self.by_id('goal').send_keys('9.5 8.5', Keys.ENTER)
        self.wait_for('Solved')
        mark = self.browser.find_element(By.CSS_SELECTOR, '.mark.start')
        before = self.end_of('start')
        mark.send_keys(Keys.ARROW_RIGHT)
        self.assertGreater(self.end_of('start')[0], before[0])
        self.by_id('clear').click()
        self.by_id('map').send_keys('s')
        self.wait_for('Click where to go')
        self.by_id('map').send_keys('+')
        self.wait(lambda: self.run_script('return map.getZoom()') > 0)
        self.by_id('start').clear()
        self.by_id('start').send_keys('one, two', Keys.TAB)
        self.wait_for('The start is x, y.')

    def test_a_blocked_end_is_moved_to_where_it_fits(self):
        with Service(WARREN, self.path('block.scene')) as service:
            self.shown(service)
            self.wait_for('does not fit at the start')
            self.by_id('move').click()
            self.wait_for('Solved')

    def test_titles_are_text(self):
        with Service(WARREN, self.path('<img src=x onerror=alert(1)>.scene')) as service:
            self.shown(service)
            self.assertEqual(self.by_id('title').text, '<img src=x onerror=alert(1)>.scene')

    def test_bodies_that_turn_have_headings(self):
        with Service(WARREN, WORLDS + '/parking.scene') as service:
            self.shown(service)
            self.wait(lambda: self.status() != '' and 'Click' not in self.status())
            self.assertIn('Solved', self.status())
            self.assertGreater(len(self.drawn()), len(self.run_script('return answer.json.path')) // 2)
            self.assertEqual(len(self.by_id('start').get_attribute('value').split(',')), 3)

    def test_every_zoom_shows_the_maze(self):
        self.shown(self.maze)
        for zoom in range(self.run_script('return world.tiles.levels')):
            self.run_script('map.setView([150.5, 150.5], arguments[0], {animate: false})', zoom)
            self.wait(lambda: not self.run_script('return tiles._loading'))
            shown = self.run_script('return [...document.querySelectorAll(".tiles img.leaflet-tile-loaded")].filter(i => i.naturalWidth === 512).length')
            self.assertGreater(shown, 0, zoom)
            self.assertEqual(self.run_script('return [...document.querySelectorAll(".tiles img")].filter(i => i.complete && i.naturalWidth === 0).length'), 0)

    def test_nothing_of_the_last_answer_stays_when_the_service_is_gone(self):
        service = Service(WARREN, self.path('block.scene'))
        self.addCleanup(service.stop)
        self.shown(service, '#start=1,1&goal=9,9')
        self.wait_for('Solved')
        self.assertEqual(service.stop(), 0)
        self.by_id('question').submit()
        self.wait_for('does not answer any more')
        for name in ('save-geojson', 'save-csv', 'save-json'):
            self.assertFalse(self.by_id(name).is_enabled(), name)
        self.assertEqual(self.by_id('figures').text, '')
        self.assertEqual([entry['source'] for entry in self.browser.get_log('browser')], ['network'])

    def test_layers_dark_and_phone(self):
        self.media(color_scheme='dark')
        self.shown(self.maze, '#start=1,1&goal=300,300')
        self.wait_for('Solved')
        self.assertTrue(self.run_script('return document.documentElement.classList.contains("dark")'))
        self.by_id('dark').click()
        self.assertFalse(self.run_script('return document.documentElement.classList.contains("dark")'))
        self.by_id('show-path').click()
        self.assertFalse(self.run_script('return map.hasLayer(pathLine.line)'))
        self.by_id('show-world').click()
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, '.tiles'), [])
        self.browser.set_window_size(500, 900)
        self.frames()
        self.assertGreater(self.run_script('return map.getContainer().clientHeight'), 200)
        self.assertLessEqual(self.run_script('return document.documentElement.scrollWidth'), self.run_script('return innerWidth'))


if __name__ == '__main__':
    unittest.main()
