"""A browser that opens pages of results: wide and on a phone, light and dark. Skipped, and said so, without one."""

import shutil
import tempfile
import unittest

import support

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
except ImportError:
    webdriver = None

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
FLAGS = ("--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
         "--disable-component-update --disable-sync --hide-scrollbars").split()
needs_browser = unittest.skipUnless(webdriver and CHROMIUM and DRIVER,
                                    "no browser here (Debian: chromium chromium-driver python3-selenium)")


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        options = Options()
        options.binary_location = CHROMIUM
        cls.profile = tempfile.mkdtemp(prefix="torquescope_browser_")
        for flag in (*FLAGS, f"--user-data-dir={cls.profile}"):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        cls.browser = webdriver.Chrome(service=Service(DRIVER), options=options)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        shutil.rmtree(cls.profile, ignore_errors=True)

    def open(self, kind, width=1280, theme="light"):
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500})
        self.media(theme)
        self.browser.get(support.page(kind).as_uri())

    def media(self, theme, media=""):
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                     {"media": media, "features": [{"name": "prefers-color-scheme", "value": theme}]})

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def background(self):
        return self.script("return getComputedStyle(document.documentElement).backgroundColor")
