#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Is the manifest what its schema says, and does the schema refuse what it should? Exit status 77 without python3-jsonschema.
# usage: schema.sh VECTORS
set -euo pipefail
cd "$1"
if ! python3 -c 'import jsonschema; jsonschema.Draft202012Validator' 2>/dev/null; then
    echo 'schema: skipped: python3 with jsonschema 4 is not here (Debian: python3-jsonschema)'
    exit 77
fi
python3 - <<'END'
import copy, json, sys
import jsonschema

schema = json.load(open("manifest.schema.json"))
manifest = json.load(open("manifest.json"))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
problems = ["%s: %s" % ("/".join(map(str, e.absolute_path)), e.message[:200]) for e in validator.iter_errors(manifest)]
if manifest["version"] != open("VERSION").read().strip():
    problems.append("version: not that of VERSION")
ids = [c["id"] for c in manifest["cases"]]
problems += ["%s: there twice" % i for i in set(ids) if ids.count(i) > 1]
problems += ["%s: id and stage do not fit" % c["id"] for c in manifest["cases"] if c["id"].split("/")[0] != c["stage"]]
readme = open("README.md").read()
flags = {f for c in manifest["cases"] for f in c["flags"]}
problems += ["README.md does not say what flag %s means" % f for f in sorted(flags) if "`%s`" % f not in readme]

reasons = {b for c in manifest["cases"] for a in c["reference"] if isinstance(a.get("bound"), list) for b in a["bound"] if isinstance(b, str)}
problems += ["README.md does not say what '%s' means" % r for r in sorted(reasons) if "`%s`" % r not in readme]
problems += ["%s: output %s has no class" % (c["id"], a["name"]) for c in manifest["cases"] for a in c["exact"]
             if a["name"] not in [r["name"] for r in c["reference"]]]

# Each change makes the small manifest of one case wrong: the schema has to notice.
words = next(c for c in manifest["cases"] if any("q" in a and a["class"] == "lsb" for a in c["reference"]))
image = next(c for c in manifest["cases"] if any("width" in a for a in c["inputs"]))
def changed(case, change):
    m = copy.deepcopy(dict(manifest, cases=[case]))
    change(m, m["cases"][0])
    return m
changes = {
    "unknown field": (words, lambda m, c: m.update(extra=1)),
    "unknown field of a case": (words, lambda m, c: c.update(extra=1)),
    "unknown field of an input": (words, lambda m, c: c["inputs"][0].update(extra=1)),
    "unknown field of an output": (words, lambda m, c: c["exact"][0].update(extra=1)),
    "no id": (words, lambda m, c: c.pop("id")),
    "unknown stage": (words, lambda m, c: c.update(stage="blur")),
    "unknown tier": (words, lambda m, c: c.update(tier="easy")),
    "unknown flag": (words, lambda m, c: c["flags"].append("nice")),
    "no inputs": (words, lambda m, c: c.update(inputs=[])),
    "no exact tier": (words, lambda m, c: c.update(exact=[])),
    "width of words": (words, lambda m, c: c["inputs"][0].update(bits=24)),
    "no digest": (words, lambda m, c: c["inputs"][0].pop("sha256")),
    "short digest": (words, lambda m, c: c["inputs"][0].update(sha256="0" * 63)),
    "words without count": (words, lambda m, c: c["exact"][0].pop("count")),
    "words with a height": (words, lambda m, c: c["exact"][0].update(height=3)),
    "image without width": (image, lambda m, c: c["inputs"][0].pop("width")),
    "image with count": (image, lambda m, c: c["inputs"][0].update(count=3)),
    "file outside": (words, lambda m, c: c["inputs"][0].update(file="../x.hex")),
    "no class": (words, lambda m, c: c["exact"][0].pop("class")),
    "inexact exact tier": (words, lambda m, c: c["exact"][0].update({"class": "lsb", "bound": 4})),
    "bound of the exact class": (words, lambda m, c: c["exact"][0].update(bound=0)),
    "no bound": (words, lambda m, c: next(a for a in c["reference"] if a["class"] == "lsb").pop("bound")),
    "bound beyond a double": (words, lambda m, c: c["reference"][0].update({"class": "lsb", "bound": 2**53 + 1})),
    "unknown reason": (words, lambda m, c: c["reference"][0].update({"class": "lsb", "bound": [4, "difficult"]})),
    "negative bound": (words, lambda m, c: c["reference"][0].update({"class": "lsb", "bound": -1})),
}
for case in (words, image):
    if not validator.is_valid(changed(case, lambda m, c: None)):
        problems.append("a sound manifest of %s is refused" % case["id"])
for name, (case, change) in changes.items():
    if validator.is_valid(changed(case, change)):
        problems.append("the schema does not notice: " + name)
for p in problems:
    print("schema: " + p)
print("schema: %d cases, %d wrong manifests noticed, %d problems" % (len(ids), len(changes), len(problems)))
sys.exit(1 if problems else 0)
END
