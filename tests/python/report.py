# SPDX-License-Identifier: Apache-2.0
"""The report in a real browser: headless Chromium, driven over its debugging protocol through pipes. The page must draw
its plots, the slider must change picture and facts, and nothing may be an error on the console or loaded from elsewhere.

usage: report.py REPORT.html SCREENSHOT.png    exit status 77: there is no Chromium"""
import base64
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile


class Browser:
    """Chromium with --remote-debugging-pipe: messages that end with a 0 byte, in by descriptor 3, out by 4."""

    def __init__(self, program, profile):
        to_browser, self.write = os.pipe()
        self.read, from_browser = os.pipe()
        # The shell puts the pipes on the descriptors that Chromium expects.
        command = (f'exec "$0" --headless=new --no-sandbox --disable-gpu --user-data-dir="$1" --remote-debugging-pipe '
                   f'--window-size=1500,1600 about:blank 3<&{to_browser} 4>&{from_browser}')
        self.process = subprocess.Popen(['bash', '-c', command, program, profile], pass_fds=(to_browser, from_browser),
                                        stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer, self.number, self.events = b'', 0, []

    def receive(self):
        while b'\0' not in self.buffer:
            data = os.read(self.read, 1 << 16)
            if not data:
                raise RuntimeError('the browser has ended')
            self.buffer += data
        message, _, self.buffer = self.buffer.partition(b'\0')
        return json.loads(message)

    def call(self, method, session=None, **parameters):
        self.number += 1
        message = {'id': self.number, 'method': method, 'params': parameters}
        if session:
            message['sessionId'] = session
        os.write(self.write, json.dumps(message).encode() + b'\0')
        while True:
            answer = self.receive()
            if answer.get('id') == self.number:
                if 'error' in answer:
                    raise RuntimeError(f'{method}: {answer["error"]}')
                return answer['result']
            self.events.append(answer)

    def close(self):
        self.call('Browser.close')
        self.process.wait(timeout=30)

    def wait(self, method):
        while not any(event.get('method') == method for event in self.events):
            self.events.append(self.receive())


def look(browser, page, screenshot):
    target = browser.call('Target.createTarget', url='about:blank')['targetId']
    session = browser.call('Target.attachToTarget', targetId=target, flatten=True)['sessionId']
    for domain in ('Page', 'Runtime', 'Log', 'Network'):
        browser.call(f'{domain}.enable', session)

    def value(expression):
        result = browser.call('Runtime.evaluate', session, expression=expression, returnByValue=True, awaitPromise=True)
        assert 'exceptionDetails' not in result, result
        return result['result'].get('value')

    browser.call('Page.navigate', session, url=page.resolve().as_uri())
    browser.wait('Page.loadEventFired')
    value('new Promise(done => setTimeout(done, 500))')
    assert value('document.querySelectorAll("#plots .xy, #plots .x2y2, #plots .x6y6").length') >= 3, 'no plots'
    traces = value('document.getElementById("plots").data.length')
    assert traces >= 5 * 3 + 2, traces
    last = value('rows.length - 1')
    first = value('[document.getElementById("picture").src.length, document.getElementById("facts").innerText]')
    assert first[0] > 1000 and 'tracking' in first[1], first[1]
    assert value('document.getElementById("picture").decode().then(() => document.getElementById("picture").naturalWidth)') > 1
    value(f'slider.value = {last}; slider.dispatchEvent(new Event("input")); 0')
    assert value('document.getElementById("number").textContent') == f'{last + 1} of {last + 1}'
    assert value('document.getElementById("facts").innerText') != first[1], 'the slider changes nothing'
    assert value('plots.layout.shapes[0].x0 === rows[rows.length - 1].time'), 'no line in the plots at the frame shown'
    data = browser.call('Page.captureScreenshot', session)['data']
    screenshot.write_bytes(base64.b64decode(data))
    bad = [e for e in browser.events
           if e.get('method') == 'Runtime.exceptionThrown'
           or (e.get('method') == 'Log.entryAdded' and e['params']['entry']['level'] == 'error')
           or (e.get('method') == 'Runtime.consoleAPICalled' and e['params']['type'] == 'error')
           or (e.get('method') == 'Network.requestWillBeSent'
               and not e['params']['request']['url'].startswith(('file:', 'data:', 'blob:', 'about:')))]
    assert not bad, json.dumps(bad)[:600]
    print(f'report: {last + 1} frames, {traces} traces, no error; looked at in {screenshot}')


def main():
    program = shutil.which('chromium') or shutil.which('chromium-browser') or shutil.which('google-chrome')
    if program is None:
        print('report: skipped, there is no Chromium')
        return 77
    # The browser's own children write in the profile until the last of them has ended: no matter of the report's.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(program, profile)
        try:
            look(browser, pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
            browser.close()
        finally:
            browser.process.kill()
            browser.process.wait()
    return 0


if __name__ == '__main__':
    sys.exit(main())
