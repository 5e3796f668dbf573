#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""What an older revision says and the present one does not: messages, keywords, numbers, and sentences of the manual and the READMEs.

    tools/dropped.py REVISION [SHARE]

A sentence is listed if no three successive sentences of today have SHARE (0.7) of its words, rare words counting more.
Read the list: each line is said with other words, replaced by a later result, dropped on purpose, or lost.
"""
import collections
import math
import re
import subprocess
import sys

PAGES = re.compile(r"doc/src/[^/]*\.rst|doc/contributing/.*\.md|(examples/.*|bench/)?README\.md|CONTRIBUTING\.md")
SOURCES = re.compile(r"(src|plugin)/.*\.(cpp|h)")
COMMON = set("the a an of and or is are it its in to for with that this these as by on at be from which not no if so has have was one".split())


def texts(revision, pattern):
    names = subprocess.check_output(["git", "ls-tree", "-r", "--name-only", "--full-tree", revision], text=True).split()
    return {name: subprocess.check_output(["git", "show", f"{revision}:{name}"], text=True) for name in names if pattern.fullmatch(name)}


def sentences(text):
    for markup, plain in (r":\w+:`([^`<]*?)\s*(<[^>]*>)?`", r"\1"), (r"\]\([^)]*\)", "]"), (r"[`*|\\\[\]]+", " "):
        text = re.sub(markup, plain, text)
    parts = re.split(r"\n\s*\n|(?<=[.:;?!])\s+(?=[A-Z0-9])|\s[-#]\s", text)
    return [" ".join(part.split()) for part in parts if part.strip()]


def words(sentence):
    found = re.findall(r"[a-z_]+|\d[\d.,e^]*\d|\d", sentence.lower())
    return {re.sub(r"(?<=...)(ing|ed|es|s|ly)$", "", word) for word in found if word not in COMMON}


share = float(sys.argv[2]) if len(sys.argv) > 2 else 0.7
(old, old_sources), (new, new_sources) = ((texts(r, PAGES), texts(r, SOURCES)) for r in (sys.argv[1], "HEAD"))
for what, pattern, before, after in (("message", r'"([^"\n]* [^"\n]* [^"\n]*)"', old_sources, new_sources),
                                     ("keyword", r"\*([a-z_]+(?:/[a-z0-9_]+)*)\*", old, new),
                                     ("number", r"(?<![\w.])\d+\.\d+(?!\w)", old, new)):
    now = set(re.findall(pattern, "\n".join(after.values())))
    for name, text in before.items():
        for match in sorted(set(re.findall(pattern, text)) - now):
            print(f"{what}: {name}: {match}")
lists = [sentences(text) for text in new.values()]
known, windows = {s for part in lists for s in part}, [words(" ".join(part[i:i + 3])) for part in lists for i in range(len(part))]
places = collections.defaultdict(list)
for i, word in ((i, word) for i, window in enumerate(windows) for word in window):
    places[word].append(i)
for name, text in old.items():
    for sentence in (s for s in sentences(text) if s not in known):
        weight = {word: math.log((len(windows) + 1) / (len(places[word]) + 0.5)) for word in words(sentence)}
        shared = collections.Counter()
        for word, value in weight.items():
            shared.update(dict.fromkeys(places[word], value))
        if max(shared.values(), default=0) < share * sum(weight.values()):
            print(f"sentence: {name}: {sentence}")
