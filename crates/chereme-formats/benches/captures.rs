//! Reading captures beside the libraries that others use, in one run: `gltf`, `ufbx` alone, and, if `CHEREME_PYTHON` names a
//! Python that has them, `ezc3d`, `c3d` and `pose-format`. Prints a table of medians and ratios.
//!
//! `CHEREME_SHARED_DATA=... CHEREME_PYTHON=... cargo bench -p chereme-formats --bench captures`; without other people's
//! captures only a GLB of the program's own is read. A table in which no peer is missing is written to RESULTS.md.

#![allow(clippy::print_stdout, reason = "a program prints its table")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use chereme_formats::{c3d, gltf as own_gltf, pose};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Clip, FrameRate, JointChannel, Skeleton, SkeletonJoint};

/// The number of times that each file is read.
const ROUNDS: usize = 21;

/// The text before the table in the file of results.
const HEAD: &str = "# Results of chereme-formats

Figures of the version in this repository; each section names the command that writes it again.

## Captures beside other readers

`CHEREME_SHARED_DATA=... CHEREME_PYTHON=... cargo bench -p chereme-formats --bench captures`: medians of 21 readings of bytes in
memory, one after the other in one run (peers in Python open the file unless the table says otherwise). *Ratio* is the peer's
time divided by that of this program: above 1 this program is faster. Peers do less where the table says so: numbers as they
are stored, or a scene without its movement.

| file | this program | peer | its time | ratio |
|---|--:|---|--:|--:|
";

fn main() {
    let mut table = Table::default();
    let bytes = own_gltf::write_glb(&body(), &own_gltf::GlbDescription::default()).expect("a GLB");
    let own = median(|| assert!(own_gltf::read_gltf(&bytes, &|_| None).is_ok()));
    let peer = median(|| assert!(sum_of(&bytes) > 100_000.0));
    table.row(
        "65 joints, 3,600 frames, .glb",
        own,
        "`gltf` 1.4, numbers as stored",
        peer,
    );
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA").map(PathBuf::from) else {
        print!("{}", table.text);
        println!("\nCHEREME_SHARED_DATA is not set: other people's captures are left out.");
        return;
    };
    fbx(&data.join("motion/fbx"), &mut table);
    let c3d_file = find(&data.join("motion/c3d"), "walking2.c3d");
    let pose_file = find(&data.join("motion/pose"), "sample-data-example.pose");
    for (file, peers) in [
        (
            c3d_file,
            [
                ("ezc3d", "import ezc3d", "ezc3d.c3d(F)"),
                ("c3d", "import c3d", "list(c3d.Reader(open(F,'rb')).read_frames())"),
            ],
        ),
        (
            pose_file,
            [
                ("pose-format", "from pose_format import Pose", "Pose.read(open(F,'rb'))"),
                (
                    "pose-format, bytes in memory",
                    "from pose_format import Pose; B=open(F,'rb').read()",
                    "Pose.read(B)",
                ),
            ],
        ),
    ] {
        let Some(file) = file else {
            table.missing.push(format!("a capture for {}", peers[0].0));
            continue;
        };
        let bytes = std::fs::read(&file).expect("read");
        let is_pose = file.extension().is_some_and(|it| it == "pose");
        let own = median(|| match is_pose {
            true => assert!(pose::read_pose_file(&bytes).is_ok()),
            false => assert!(c3d::read_c3d(&bytes).is_ok()),
        });
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        for (peer, before, call) in peers {
            match python(&file, before, call) {
                Ok(time) => table.row(&name, own, peer, time),
                Err(why) => table.missing.push(format!("{peer} ({why})")),
            }
        }
    }
    print!("{}", table.text);
    if table.missing.is_empty() {
        let results = Path::new(env!("CARGO_MANIFEST_DIR")).join("RESULTS.md");
        std::fs::write(results, format!("{HEAD}{}", table.text)).expect("write RESULTS.md");
    } else {
        println!("\nnot compared: {}", table.missing.join(", "));
    }
}

/// The rows, and what they lack.
#[derive(Default)]
struct Table {
    text: String,
    missing: Vec<String>,
}

impl Table {
    fn row(&mut self, file: &str, own: f64, peer: &str, time: f64) {
        let (own, time) = (own * 1e3, time * 1e3);
        let ratio = time / own;
        writeln!(
            self.text,
            "| {file} | {own:.2} ms | {peer} | {time:.2} ms | {ratio:.2} |"
        )
        .expect("a text grows");
    }
}

fn median(mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let begun = Instant::now();
            work();
            begun.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[ROUNDS / 2]
}

/// Returns the median of a call in Python, in seconds. Fails with the reason if the call was impossible.
fn python(file: &Path, before: &str, call: &str) -> Result<f64, String> {
    let program = std::env::var_os("CHEREME_PYTHON").ok_or("CHEREME_PYTHON is not set")?;
    let script = format!(
        "import sys,time,warnings\nwarnings.simplefilter('ignore')\nF=sys.argv[1]\n{before}\nt=[]\nfor _ in range({ROUNDS}):\n b=time.perf_counter()\n {call}\n \
         t.append(time.perf_counter()-b)\nprint(sorted(t)[{}])",
        ROUNDS / 2
    );
    let output = Command::new(program)
        .arg("-c")
        .arg(script)
        .arg(file)
        .output()
        .map_err(|error| error.to_string())?;
    let last = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes);
        text.lines().last().unwrap_or_default().trim().to_owned()
    };
    let time = last(&output.stdout);
    time.parse().map_err(|_| last(&output.stderr))
}

/// Returns a file of that name somewhere below a folder.
fn find(folder: &Path, name: &str) -> Option<PathBuf> {
    let entries = std::fs::read_dir(folder).ok()?.flatten();
    entries.map(|it| it.path()).find_map(|path| match path.is_dir() {
        true => find(&path, name),
        false => path.file_name().is_some_and(|it| it == name).then_some(path),
    })
}

/// A body of 65 joints that all turn, two minutes at 30 frames a second.
fn body() -> Clip {
    let mut joints = vec![SkeletonJoint::new("Hips", None, DVec3::Y)];
    joints.extend((1..65).map(|at| SkeletonJoint::new(format!("joint{at}"), Some((at - 1) / 2), DVec3::X * 0.1)));
    let skeleton = Skeleton::new(joints).expect("a skeleton");
    let channels = (0..65).map(|joint| JointChannel {
        rotations: (0..3600)
            .map(|frame| DQuat::from_rotation_x((f64::from(frame) * 0.01 + f64::from(joint)).sin()))
            .collect(),
        translations: None,
    });
    Clip::new(
        skeleton.into(),
        FrameRate::new(30, 1).expect("a rate"),
        channels.collect(),
    )
    .expect("a clip")
}

/// Reads every number of every sampler with the crate `gltf`, and returns the sum of all.
fn sum_of(bytes: &[u8]) -> f64 {
    let file = gltf::Gltf::from_slice_without_validation(bytes).expect("a document");
    let blob = file.blob.as_deref().unwrap_or_default();
    let mut sum = 0.0;
    let mut add = |number: f32| sum += f64::from(number);
    for channel in file.animations().flat_map(|it| it.channels().collect::<Vec<_>>()) {
        let reader = channel.reader(|_| Some(blob));
        reader.read_inputs().into_iter().flatten().for_each(&mut add);
        match reader.read_outputs() {
            Some(gltf::animation::util::ReadOutputs::Rotations(all)) => {
                all.into_f32().flatten().for_each(&mut add);
            }
            Some(gltf::animation::util::ReadOutputs::Translations(all)) => {
                all.flatten().for_each(&mut add);
            }
            _ => {}
        }
    }
    sum
}

#[cfg(feature = "fbx")]
fn fbx(folder: &Path, table: &mut Table) {
    let Some(file) = find(folder, "simple_anim.fbx") else {
        table.missing.push("simple_anim.fbx".into());
        return;
    };
    let bytes = std::fs::read(&file).expect("read");
    let own = median(|| assert!(chereme_formats::fbx::read_fbx(&bytes).is_ok()));
    let options = || ufbx::LoadOpts {
        ignore_geometry: true,
        ..ufbx::LoadOpts::default()
    };
    let loaded = median(|| {
        ufbx::load_memory(&bytes, options()).expect("a scene");
    });
    table.row(
        "simple_anim.fbx, 161 nodes, 6 frames",
        own,
        "`ufbx` 0.11, loaded",
        loaded,
    );
    let played = median(|| {
        let scene = ufbx::load_memory(&bytes, options()).expect("a scene");
        let mut sum = 0.0;
        for frame in 0..6 {
            for node in &scene.nodes {
                let time = f64::from(frame) / 30.0;
                sum += ufbx::evaluate_transform(&scene.anim, node, time).rotation.w;
            }
        }
        assert!(sum.is_finite());
    });
    table.row(
        "simple_anim.fbx, 161 nodes, 6 frames",
        own,
        "`ufbx` 0.11, every node at every frame",
        played,
    );
}

#[cfg(not(feature = "fbx"))]
fn fbx(_: &Path, table: &mut Table) {
    table.missing.push("FBX (the feature `fbx` is off)".into());
}
