#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts the CMSIS-Pack together: the description beside this file, and the files that it names.

usage: cmsis_pack.py FOLDER     writes FOLDER/Drogue.drogue.VERSION.pack"""
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as tree
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    description = HERE / 'Drogue.drogue.pdsc'
    package = tree.parse(description).getroot()
    version = package.find('releases/release').get('version')
    target = pathlib.Path(sys.argv[1]) / f'Drogue.drogue.{version}.pack'
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work, zipfile.ZipFile(target, 'w', zipfile.ZIP_DEFLATED) as pack:
        subprocess.run([sys.executable, HERE / 'amalgamate.py', work], check=True, stdout=subprocess.DEVNULL)
        pack.write(description, description.name)
        pack.write(ROOT / 'LICENSE', package.find('license').text)
        for file in package.iter('file'):
            name = file.get('name')
            if not name.endswith('/'):
                made = pathlib.Path(work) / name.removeprefix('source/')
                pack.write(made if made.exists() else ROOT / name, name)
    print(f'cmsis_pack: {target}')


if __name__ == '__main__':
    main()
