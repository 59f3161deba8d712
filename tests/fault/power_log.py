"""What a disk may hold after the power went, of a log that shim.c wrote.

Strict, as POSIX is: of a file, only what its last fsync covered is safe; of what was written since, each page of 4 KiB
is there or not, by chance, and so is the new length. Of a folder, only what its last fsync covered is safe; each name
that was made, renamed or taken away since is there or not, by chance and one by one. Real disks and file systems keep
more.
"""

import os

PAGE = 4096


class Step:
    """One line of the log: what (its word), its words, its bytes."""

    def __init__(self, what, words, data=b""):
        self.what, self.words, self.data = what, words, data


def read_log(path):
    steps = []
    with open(path, "rb") as file:
        whole = file.read()
    place = 0
    while place < len(whole):
        end = whole.index(b"\n", place)
        what, _, rest = whole[place:end].decode().partition(" ")
        place = end + 1
        size = int(rest.rsplit(" ", 1)[1]) if what in ("write", "said") else 0
        words = rest.split("\t") if what in ("rename", "link") else [rest] if what in ("unlink", "sync_folder", "mkdir",
                                                                                      "rmdir") else rest.split(" ", 2)
        steps.append(Step(what, words, whole[place:place + size]))
        place += size
    return steps


class File:
    def __init__(self, content=b""):
        self.now = bytearray(content)
        self.safe = bytes(content)
        self.dirty = set()  # pages written since the last fsync

    def write(self, offset, data):
        if offset > len(self.now):
            self.now.extend(bytes(offset - len(self.now)))
        self.now[offset:offset + len(data)] = data
        self.dirty.update(range(offset // PAGE, (offset + len(data) - 1) // PAGE + 1))

    def resize(self, size):
        del self.now[size:]
        self.now.extend(bytes(size - len(self.now)))
        self.dirty.add(size // PAGE)

    def sync(self):
        self.safe = bytes(self.now)
        self.dirty.clear()

    def after_power_loss(self, chance):
        if not self.dirty:
            return self.safe
        size = chance.choice((len(self.safe), len(self.now)))
        content = bytearray(self.safe[:size])
        content.extend(bytes(size - len(content)))
        for page in self.dirty:
            if chance.random() < 0.5:
                part = self.now[page * PAGE:min((page + 1) * PAGE, size)]
                content[page * PAGE:page * PAGE + len(part)] = part
        return bytes(content[:size])


FOLDER = "a folder"


class Disk:
    """Follows a log step by step; image() is what could be left at that moment."""

    def __init__(self, root, content):
        self.root = root
        self.names = {os.path.join(root, name): File(data) for name, data in content.items()}  # as a reader sees them
        self.safe_names = dict(self.names)
        self.ever = dict(self.names)  # what each name last stood for, gone or not: a cut may bring it back
        self.changes = []  # of names, since each folder's last fsync: (folder, what happens to a table of names)
        self.opened = {}
        self.said = []  # by each process

    def change(self, path, effect):
        effect(self.names)
        self.changes.append((os.path.dirname(path), effect))

    def name(self, path, file):
        self.ever[path] = file
        self.change(path, lambda names: names.__setitem__(path, file))

    def forget(self, path):
        self.change(path, lambda names: names.pop(path, None))

    def move(self, old, new):
        file = self.ever[new] = self.names[old]

        def effect(names):
            names.pop(old, None)
            names[new] = file

        self.change(new, effect)

    def do(self, step):
        words = step.words
        if step.what == "create":
            self.opened[words[0]] = File()
            self.name(words[1], self.opened[words[0]])
        elif step.what == "open":
            self.opened[words[0]] = self.names[words[1]]
        elif step.what == "write":
            self.opened[words[0]].write(int(words[1]), step.data)
        elif step.what == "resize":
            self.opened[words[0]].resize(int(words[1]))
        elif step.what == "sync":
            self.opened[words[0]].sync()
        elif step.what == "sync_folder":
            for folder, effect in self.changes:
                if folder == words[0]:
                    effect(self.safe_names)
            self.changes = [change for change in self.changes if change[0] != words[0]]
        elif step.what == "rename":
            self.move(*words)
        elif step.what == "link":
            self.name(words[1], self.names[words[0]])
        elif step.what == "mkdir":
            self.name(words[0], FOLDER)
        elif step.what in ("unlink", "rmdir"):
            self.forget(words[0])
        elif step.what == "said":
            self.said[-1] += step.data
        elif step.what == "begin":
            self.said.append(b"")
        else:
            raise ValueError(step.what)

    def image(self, chance):
        """Names and bytes that could be left: a folder's name maps to None."""
        names = dict(self.safe_names)
        for _, effect in self.changes:
            if chance.random() < 0.5:
                effect(names)
        folders = {self.root} | {path for path, file in names.items() if file is FOLDER}
        return {os.path.relpath(path, self.root): None if file is FOLDER else file.after_power_loss(chance)
                for path, file in names.items() if os.path.dirname(path) in folders}


def write_image(image, folder):
    for name in sorted(image):
        path = os.path.join(folder, name)
        if image[name] is None:
            os.mkdir(path)
        else:
            with open(path, "wb") as file:
                file.write(image[name])
