# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium for tests of pages: nothing is loaded from any network, and what its console says is kept."""
import os
import shutil
import tempfile
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

FLAGS = ('--headless=new --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking '
         '--disable-component-update --disable-sync --disable-default-apps --window-size=1200,800').split()


shared = None  # all_pages.py starts one for all files


def start(folder):
    options = Options()
    options.binary_location = shutil.which('chromium')
    for flag in FLAGS + ['--user-data-dir=' + os.path.join(folder, 'profile')]:
        options.add_argument(flag)
    options.set_capability('goog:loggingPrefs', {'browser': 'ALL'})
    return webdriver.Chrome(service=Service(shutil.which('chromedriver')), options=options)


def open_anew(browser):
    """A window without cookies, storage, cache, history or emulation of the one before, which is closed."""
    old = browser.current_window_handle
    browser.switch_to.new_window('window')
    new = browser.current_window_handle
    browser.switch_to.window(old)
    browser.close()
    browser.switch_to.window(new)
    for command, words in (('Network.clearBrowserCookies', {}), ('Network.clearBrowserCache', {}),
                           ('Storage.clearDataForOrigin', {'origin': '*', 'storageTypes': 'all'})):
        browser.execute_cdp_cmd(command, words)
    browser.set_window_size(1200, 800)


class BrowserTest(unittest.TestCase):
    """One browser for all tests of a class; a test fails where the console has a message at its end."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        if shared is not None:
            cls.browser = shared
            open_anew(shared)
            return
        cls.browser = start(cls.folder.name)
        cls.addClassCleanup(cls.browser.quit)

    def tearDown(self):
        self.browser.set_window_size(1200, 800)
        self.media()
        self.assertEqual(self.browser.get_log('browser'), [])

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def open(self, name):
        self.browser.get('file://' + self.path(name))

    def run_script(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def async_script(self, script, *arguments):
        """The script calls done(value)."""
        return self.browser.execute_async_script('const done = arguments[arguments.length - 1];' + script, *arguments)

    def frames(self):
        """Waits until what was asked for is drawn."""
        self.async_script('requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 0)))')

    def media(self, **features):
        """color_scheme='dark', reduced_motion='reduce'"""
        said = [{'name': 'prefers-' + name.replace('_', '-'), 'value': value} for name, value in features.items()]
        self.browser.execute_cdp_cmd('Emulation.setEmulatedMedia', {'features': said})

    def actions(self):
        """Moves of the mouse at once, not in a quarter of a second each."""
        return ActionChains(self.browser, duration=0)

    def touch(self, kind, *points):
        self.browser.execute_cdp_cmd('Input.dispatchTouchEvent',
                                     {'type': kind, 'touchPoints': [{'x': x, 'y': y, 'id': i} for i, (x, y) in enumerate(points)]})

    def wait(self, holds):
        WebDriverWait(self.browser, 60, 0.05).until(lambda _: holds())

    def by_id(self, name):
        return self.browser.find_element(By.ID, name)

    def press(self, name):
        element = self.by_id(name)
        self.run_script('arguments[0].scrollIntoView({block: "center"})', element)
        element.click()


class MapTest(BrowserTest):
    """The page of `warren serve`: places are those of the world."""

    def show_map(self, address):
        self.browser.get('about:blank')  # the part behind # alone would load nothing
        self.browser.get(address)
        self.wait(lambda: self.run_script('return world !== null && map !== null && map._loaded === true && !tiles._loading'))

    def rest(self):
        """Until nothing moves: tiles are there and have faded in, zooms have ended, and that is drawn."""
        self.wait(lambda: self.run_script('''
            let still = !map._animatingZoom;
            map.eachLayer(layer => {
              still &&= !layer._loading && Object.values(layer._tiles ?? {}).every(tile => tile.active || !tile.current);
            });
            return still;'''))
        self.frames()

    def status(self):
        return self.by_id('status').text

    def wait_for(self, words):
        self.wait(lambda: words in self.status())

    def offset(self, x, y):
        """Pixels from the map's middle."""
        return self.run_script('const p = map.latLngToContainerPoint([arguments[1], arguments[0]]), b = map.getContainer().getBoundingClientRect();'
                               'return [Math.round(p.x - b.width / 2), Math.round(p.y - b.height / 2)]', x, y)

    def at(self, x, y):
        return self.actions().move_to_element_with_offset(self.by_id('map'), *self.offset(x, y))

    def click_at(self, x, y):
        self.at(x, y).click().perform()
