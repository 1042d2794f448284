# Turns the annotations of imported GLB files into markers of Blender's timeline.
#
# Open it in Blender's text editor and run it after File > Import > glTF 2.0, or run
#   blender --background --python annotations_to_markers.py -- FILE.glb RESULT.blend
import json
import sys

import bpy


def import_file(path):
    """Imports a GLB at its own frame rate, which glTF does not set by itself."""
    with open(path, "rb") as file:
        head = file.read(20)
        document = json.loads(file.read(int.from_bytes(head[12:16], "little")))
    scene = document["scenes"][document.get("scene", 0)]
    rate = scene.get("extras", {}).get("chereme_frames_per_second", 25.0)
    render = bpy.context.scene.render
    render.fps = max(1, round(rate))
    render.fps_base = render.fps / rate
    bpy.ops.import_scene.gltf(filepath=path)


def add_markers(scene):
    """Adds a marker at the beginning of each annotation; returns how many."""
    text = scene.get("chereme_annotations")
    if text is None:
        return 0
    rate = scene.render.fps / scene.render.fps_base
    count = 0
    for note in json.loads(text):
        name = f"{note['tier']}: {note['value']}" if note["value"] else note["tier"]
        scene.timeline_markers.new(name, frame=round(note["begin"] * rate))
        count += 1
    return count


arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
if arguments:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    import_file(arguments[0])
made = sum(add_markers(scene) for scene in bpy.data.scenes)
print(f"{made} markers")
if len(arguments) > 1:
    bpy.ops.wm.save_as_mainfile(filepath=arguments[1])
