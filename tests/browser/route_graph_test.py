# SPDX-License-Identifier: BSD-3-Clause
"""route_graph_test.py WARREN: route graphs of a robot's map, edited as people do it in a headless Chromium: built, nodes moved,
added and deleted by mouse and keys, edges through walls refused, saved as Nav2 loads them, opened again."""
import json
import os
import sys
import unittest

from selenium.webdriver.common.keys import Keys

from browser import MapTest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, '..', 'acceptance'))
from service import Service  # noqa: E402

WARREN = sys.argv.pop(1)
WIDTH, HEIGHT, CELL = 120, 80, 0.1  # 12 x 8 m, around a block of 4 x 2


def write_map(folder):
    """The lower left corner is at (-2, -1)."""
    def is_wall(x, y):
        return x in (0, WIDTH - 1) or y in (0, HEIGHT - 1) or (40 <= x < 80 and 30 <= y < 50)
    rows = [bytes(0 if is_wall(x, HEIGHT - 1 - y) else 254 for x in range(WIDTH)) for y in range(HEIGHT)]
    with open(folder + '/yard.pgm', 'wb') as file:
        file.write(b'P5 %d %d 255\n' % (WIDTH, HEIGHT) + b''.join(rows))
    with open(folder + '/yard.yaml', 'w', encoding='utf-8') as file:
        file.write('image: yard.pgm\nresolution: 0.1\norigin: [-2.0, -1.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n')
    return folder + '/yard.yaml'


def nav2(text):
    """(nodes, edges) by the rules of Nav2's GeoJsonGraphFileLoader and its guide."""
    nodes, edges, ids = {}, {}, set()
    for feature in json.loads(text)['features']:
        properties, geometry = feature['properties'], feature['geometry']
        assert isinstance(properties['id'], int) and 0 <= properties['id'] < 2**32 - 1 and properties['id'] not in ids
        ids.add(properties['id'])
        if geometry['type'] == 'Point':
            assert properties['frame'] == 'map'
            nodes[properties['id']] = tuple(geometry['coordinates'])
        else:
            assert geometry['type'] == 'MultiLineString'
            edges[properties['id']] = (properties['startid'], properties['endid'], float(properties['cost']), geometry['coordinates'])
    for start, end, _, line in edges.values():
        assert [tuple(p) for p in line[0]] == [nodes[start], nodes[end]]
    assert nodes and edges
    return nodes, edges


class RouteGraph(MapTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.service = Service(WARREN, write_map(cls.folder.name), '--robot', 'disc 0.3')

    @classmethod
    def tearDownClass(cls):
        assert cls.service.stop() == 0
        super().tearDownClass()

    def setUp(self):
        super().setUp()
        self.show_map(self.service.url)
        self.run_script('byId("graph").open = true; window.saved = []; save = (name, type, text) => saved.push(text);')

    def tearDown(self):
        """What the service refuses is on the console by the browser's own word."""
        self.browser.set_window_size(1200, 800)
        said = [entry for entry in self.browser.get_log('browser') if entry['source'] != 'network' or '/api/graph' not in entry['message']]
        self.assertEqual(said, [])

    def settled(self):
        """All edges have been judged."""
        self.wait(lambda: self.run_script('return [...graph.edges.values()].every(verdictOf)'))

    def counts(self):
        return self.run_script('return [graph.nodes.size, graph.edges.size, blockedEdges().length]')

    def drag(self, start, end):
        a, b = self.offset(*start), self.offset(*end)
        chain = self.at(*start).click_and_hold()
        for k in range(1, 5):
            chain = chain.move_by_offset((b[0] - a[0]) * k // 4 - (b[0] - a[0]) * (k - 1) // 4, (b[1] - a[1]) * k // 4 - (b[1] - a[1]) * (k - 1) // 4)
        chain.release().perform()

    def build(self):
        self.press('graph-build')
        self.wait(lambda: 'Built' in self.status() and 'Edit ends that' in self.status())
        self.settled()

    def saved(self):
        before = self.run_script('return saved.length')
        self.press('graph-save')
        self.wait(lambda: self.run_script('return saved.length') > before)
        return self.run_script('return saved[saved.length - 1]')

    def test_built_moved_into_a_wall_and_back_added_to_and_saved(self):
        self.build()
        nodes, edges, blocked = self.counts()
        self.assertGreater(nodes, 3)
        self.assertEqual(blocked, 0)
        built = nav2(self.saved())
        self.assertEqual((len(built[0]), len(built[1])), (nodes, edges))
        name, place = next((i, p) for i, p in built[0].items() if any(i == e[0] for e in built[1].values()))
        self.drag(place, (4, 3))  # into the block
        self.settled()
        self.assertGreater(self.counts()[2], 0)
        self.assertIn('is not free', self.by_id('graph-why').text)
        self.press('graph-save')
        self.wait(lambda: 'so nothing is saved' in self.status())
        self.assertEqual(self.run_script('return saved.length'), 1)
        self.press('graph-undo')
        self.settled()
        self.assertEqual(self.counts(), [nodes, edges, 0])
        self.assertEqual(nav2(self.saved()), built)
        self.run_script('choose(null)')
        self.click_at(-1, 0)
        self.click_at(-1, 1)
        self.settled()
        self.assertEqual(self.counts(), [nodes + 2, edges + 2, 0])
        self.click_at(-1, 0.5)  # the edge
        self.assertIn('clearance', self.status())
        self.press('graph-remove')
        self.assertEqual(self.counts(), [nodes + 2, edges, 0])
        self.press('graph-undo')
        self.press('graph-redo')
        self.assertEqual(self.counts(), [nodes + 2, edges, 0])
        self.assertEqual(len(nav2(self.saved())[0]), nodes + 2)
        self.assertIn(name, built[0])

    def test_blocked_edges_are_deleted_at_once(self):
        self.press('graph-edit')
        for place in ((-1, 0), (9, 0), (9, 6), (-1, 0.7)):  # the last edge goes through the block
            self.click_at(*place)
        self.settled()
        self.assertEqual(self.counts(), [4, 6, 2])
        pixel = self.run_script('const p = pixelOf({at: [4, 3.35]}), r = devicePixelRatio;'
                                'return [...graphLayer.canvas.getContext("2d").getImageData(p.x * r - 12, p.y * r - 12, 24, 24).data]')
        self.assertTrue(any(r > 180 and g < 40 and a > 100 for r, g, a in zip(pixel[::4], pixel[1::4], pixel[3::4])), 'no red')
        self.press('graph-drop')
        self.assertEqual(self.counts(), [4, 4, 0])
        self.assertEqual(len(nav2(self.saved())[1]), 4)

    def test_by_keys_alone(self):
        self.press('graph-edit')
        keys = self.by_id('map')
        keys.send_keys('a')
        keys.send_keys(*[Keys.SHIFT + Keys.ARROW_UP + Keys.NULL] * 6)
        keys.send_keys('a')
        keys.send_keys(*[Keys.SHIFT + Keys.ARROW_DOWN + Keys.NULL] * 6)
        self.settled()
        self.assertEqual(self.counts(), [2, 2, 2])  # across the block
        keys.send_keys(Keys.CONTROL + 'z' + Keys.NULL)
        keys.send_keys(Keys.CONTROL + 'y' + Keys.NULL)
        self.assertEqual(self.counts()[:2], [2, 2])
        keys.send_keys('n')
        self.assertRegex(self.status(), 'Node 0 at .*, 2 edges; not free: ')
        keys.send_keys(Keys.DELETE)
        self.assertEqual(self.counts(), [1, 0, 0])
        keys.send_keys(Keys.ESCAPE, 'a')
        self.assertEqual(self.counts()[:2], [2, 0])
        keys.send_keys('e', 'p', 'e')
        self.assertEqual(self.counts()[:2], [2, 2])
        self.assertEqual(self.run_script('return question.start'), None)

    def test_samples_that_are_no_number_are_not_built_without(self):
        self.run_script('byId("graph-kind").value = "roadmap"')
        for text in ('1e3', '-5', '2.5', '0', 'many', '9999999999'):
            self.run_script('byId("graph-samples").value = arguments[0]; say(""); byId("graph-build").click()', text)
            self.assertIn('Samples are a whole number', self.status())
        self.assertEqual(self.counts()[:2], [0, 0])

    def test_a_file_of_nav2_is_opened_and_keeps_what_it_says(self):
        path = self.path('route.geojson')
        text = ('{"type":"FeatureCollection","name":"yard","features":['
                '{"type":"Feature","properties":{"id":5,"frame":"map","metadata":{"speed":1.0}},"geometry":{"type":"Point","coordinates":[-1,0]}},'
                '{"type":"Feature","properties":{"id":6,"frame":"map"},"geometry":{"type":"Point","coordinates":[9,0]}},'
                '{"type":"Feature","properties":{"id":8,"startid":5,"endid":6,"cost":3.5},"geometry":{"type":"MultiLineString","coordinates":[[[-1,0],[9,0]]]}}]}')
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)
        self.by_id('graph-file').send_keys(path)
        self.wait(lambda: 'Opened: 2 nodes, 1 edges' in self.status())
        self.run_script('choose("nodes", 5)')
        place = self.by_id('graph-place')
        place.clear()
        place.send_keys('-1, 0.5', Keys.ENTER)
        self.settled()
        saved = self.saved()
        self.assertIn('"metadata":{"speed":1.0}', saved)
        nodes, edges = nav2(saved)
        self.assertEqual(nodes[5], (-1, 0.5))
        self.assertEqual(edges[8][:3], (5, 6, 3.5))  # somebody's word, no length
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text.replace('"endid":6', '"endid":7'))
        self.by_id('graph-file').send_keys(path)
        self.wait(lambda: 'edge 8: there is no node 7' in self.status())

    def test_a_second_file_that_is_taken_back_leaves_the_first_one_as_it_was(self):
        self.run_script('takeGraph({nodes: [{id: 1, at: [-1, 0]}], edges: [], verdicts: [], frame: "map", more: {metadata: {who: "A"}}});'
                        'takeGraph({nodes: [{id: 2, at: [0, 0]}], edges: [], verdicts: [], frame: "odom", more: null}); undoGraph();')
        file = self.run_script('return [graph.file.get("frame"), graph.file.get("more"), [...graph.nodes.keys()]]')
        self.assertEqual(file, ['map', {'metadata': {'who': 'A'}}, [1]])
        self.assertEqual(self.run_script('redoGraph(); return [graph.file.get("frame"), graph.file.has("more")]'), ['odom', False])

    def test_edges_that_share_an_id_are_each_edited_and_saved(self):
        self.run_script('takeGraph({nodes: [{id: 1, at: [-1, 0]}, {id: 2, at: [9, 0]}], frame: "map", verdicts: [null, null, null],'
                        'edges: [{id: 7, from: 1, to: 2}, {id: 7, from: 2, to: 1}, {id: 7, from: 2, to: 2}]});')
        self.settled()
        self.assertEqual(self.counts(), [2, 3, 0])
        self.assertEqual([f['properties']['id'] for f in json.loads(self.saved())['features']], [1, 2, 7, 7, 7])
        self.run_script('graph.selected = {name: "edges", id: [...graph.edges.keys()][2]}; removeChosen()')
        self.assertEqual(self.counts()[:2], [2, 2])

    def test_by_finger(self):
        self.press('graph-edit')
        self.click_at(-1, 0)
        a, b = (self.run_script('const p = map.latLngToContainerPoint([arguments[1], arguments[0]]), b = map.getContainer().getBoundingClientRect();'
                                'return [p.x + b.left, p.y + b.top]', *place) for place in ((-1, 0), (0, 0)))
        middle = self.run_script('return [map.getCenter().lng, map.getCenter().lat]')
        self.touch('touchStart', a)
        for k in range(1, 5):
            self.touch('touchMove', [a[0] + (b[0] - a[0]) * k / 4, a[1] + (b[1] - a[1]) * k / 4])
        self.touch('touchEnd')
        at = self.run_script('return [...graph.nodes.values()][0].at')
        self.assertAlmostEqual(at[0], 0, delta=0.1)
        self.assertEqual(self.run_script('return [map.getCenter().lng, map.getCenter().lat]'), middle)
        self.assertEqual(self.counts(), [1, 0, 0])

    def test_dark_and_phone(self):
        self.build()
        self.by_id('dark').click()
        self.browser.set_window_size(500, 900)
        self.frames()
        self.assertLessEqual(self.run_script('return document.documentElement.scrollWidth'), self.run_script('return innerWidth'))


if __name__ == '__main__':
    unittest.main()
