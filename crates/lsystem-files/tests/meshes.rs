//! Files of meshes over the systems of `data_in`: prints are closed, and scenes of shared parts show what the drawing has.

use lsystem_base::{LimitName, Limits, MAX_MESH_COPIES, Meter};
use lsystem_drawing::rotation::{Axis, Rotation};
use lsystem_drawing::{Drawing, Figure, Mark, Mesh, Solid, System, draw};
use lsystem_files::{Content, FileOptions, Format, Print, collect, read_json, thin_strokes, write_glb, write_stl};
use lsystem_syntax::{Definition, Diagnostic, Heading, Kind, Style};
use serde_json::Value;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

type Point = [f64; 3];

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in").join(name)
}

fn definition(path: &Path) -> Definition {
    read_json(&std::fs::read_to_string(path).unwrap()).0.unwrap()
}

fn drawing(definition: &Definition, n: u32) -> Arc<Drawing<Solid>> {
    let system = System::new(definition).unwrap_or_else(|diagnostics| panic!("{diagnostics:?}"));
    Arc::new(draw::<Solid>(&system, n, &Limits::default()).unwrap())
}

/// The drawing with the most steps, at most the file's own number, that has at most `most` segments.
fn deepest(definition: &Definition, most: u128) -> Arc<Drawing<Solid>> {
    let fits = |drawing: &Arc<Drawing<Solid>>| drawing.segment_count() <= most;
    (0..=definition.iterations).map(|n| drawing(definition, n)).take_while(fits).last().unwrap()
}

fn tree() -> Definition {
    Definition {
        iterations: 7,
        axiom: "A".into(),
        rules: "A -> FF[{f+f+f}][S&A]/(120)'[S&A]!S'A".into(),
        overrides: "S: length times 0.7".into(),
        angle: 25.7,
        start: [2.0, -1.0],
        style: Style { width: 0.2, width_factor: 0.8, ..Style::default() },
        ..Definition::default()
    }
}

/// How often each edge of an STL goes from its lesser to its greater corner, and back.
fn edges(file: &[u8]) -> HashMap<[[u32; 3]; 2], [u32; 2]> {
    let number = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap());
    assert_eq!(file.len(), 84 + 50 * number(80) as usize);
    let mut edges = HashMap::<_, [u32; 2]>::new();
    for triangle in file[84..].chunks(50) {
        let value = |at: usize| u32::from_le_bytes(triangle[at..at + 4].try_into().unwrap());
        let [a, b, c] = [12, 24, 36].map(|at| [value(at), value(at + 4), value(at + 8)]);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            edges.entry([from.min(to), from.max(to)]).or_default()[usize::from(from > to)] += 1;
        }
    }
    edges
}

fn print(drawing: &Drawing<Solid>, style: &Style, options: &FileOptions, in_pieces: bool) -> Print {
    Print::new(drawing, style, options, in_pieces, &mut Meter::new(u64::MAX)).unwrap()
}

/// The heights at which a triangle of a print begins and ends, in order.
fn heights(print: &Print) -> Vec<[f32; 2]> {
    let ends = |triangle: &[u32; 3]| {
        let heights = triangle.map(|corner| print.corners[corner as usize][2]);
        [heights.into_iter().fold(f32::INFINITY, f32::min), heights.into_iter().fold(0.0, f32::max)]
    };
    let mut heights: Vec<[f32; 2]> = print.triangles.iter().map(ends).collect();
    heights.sort_by(|a, b| a[0].total_cmp(&b[0]));
    heights
}

#[test]
fn every_print_can_be_printed_and_no_mesh_has_empty_triangles() {
    let mut tried = 0;
    for folder in std::fs::read_dir(data("")).unwrap() {
        for file in std::fs::read_dir(folder.unwrap().path()).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_none_or(|ending| ending != "json") {
                continue;
            }
            let definition = definition(&path);
            let drawing = deepest(&definition, 1_000);
            let print = print(&drawing, &definition.style, &FileOptions::default(), false);
            if !print.triangles.is_empty() {
                tried += 1;
                assert!(print.section >= 0.5, "{}: stands on {} mm²", path.display(), print.section);
                let mut top = 0.0_f32;
                for [low, high] in heights(&print) {
                    assert!((0.0..=top + 0.05).contains(&low), "{}: a gap below {low} mm", path.display());
                    top = top.max(high);
                }
            }
            let edges = edges(&collect::<Vec<u8>, _>(|sink| write_stl(print, sink)).unwrap().0);
            // One triangle on each side, and the two go along the edge in opposite directions.
            let wrong = edges.values().filter(|&&count| count != [1, 1]).count();
            assert_eq!(wrong, 0, "{} of {} edges: {}", wrong, edges.len(), path.display());
            let mesh = Mesh::new(&drawing, &definition.style, u64::MAX).unwrap();
            let places = |triangle: &[u32; 3]| triangle.map(|corner| mesh.positions[corner as usize].map(f32::to_bits));
            let is_empty = |[a, b, c]: [[u32; 3]; 3]| a == b || b == c || c == a;
            assert!(!mesh.triangles.iter().map(places).any(is_empty), "{}: equal corners", path.display());
            let is_negative_zero = |value: &f32| value.to_bits() == (-0.0_f32).to_bits();
            assert!(!mesh.positions.iter().chain(&mesh.normals).flatten().any(is_negative_zero), "{}", path.display());
        }
    }
    assert!(tried > 90, "{tried}");
}

#[test]
fn no_wall_of_a_print_is_thinner_than_asked() {
    let definition = definition(&data("abop/1.24f.json"));
    let drawing = drawing(&definition, 3);
    let width = |options: &FileOptions| {
        let print = print(&drawing, &definition.style, &FileOptions { foot: 0.0, ..options.clone() }, true);
        let mut widths = vec![];
        for (body, &start) in print.bodies.iter().enumerate() {
            let end = print.bodies.get(body + 1).map_or(print.triangles.len(), |&end| end as usize);
            let corners = || print.triangles[start as usize..end].iter().flatten().map(|&c| print.corners[c as usize]);
            // The drawing lies in the plane y = 0.
            let [low, high] =
                [corners().map(|c| c[1]).fold(9e9, f32::min), corners().map(|c| c[1]).fold(0.0, f32::max)];
            widths.push(f64::from(high - low));
        }
        assert_eq!(widths.len(), 62);
        (widths.into_iter().fold(f64::INFINITY, f64::min), print.remark)
    };
    let usual = FileOptions::default();
    let (thinnest, remark) = width(&FileOptions { height: 20.0, ..usual.clone() });
    assert!((0.8..0.95).contains(&thinnest), "{thinnest}");
    let remark = remark.unwrap();
    assert!(remark.message.starts_with("84 strokes would be thinner than 0.8 mm"), "{}", remark.message);
    // From the height that is told on, no stroke is made thicker.
    let told: f64 = remark.hint.unwrap().split(' ').find_map(|word| word.parse().ok()).unwrap();
    assert_eq!(width(&FileOptions { height: told + 4.0, ..usual.clone() }).1, None);
    let (thinnest, remark) = width(&FileOptions { height: told - 4.0, ..usual.clone() });
    assert!(thinnest >= 0.8 && remark.is_some(), "{thinnest}");
    assert!((2.0..2.4).contains(&width(&FileOptions { thinnest: 2.0, height: 60.0, ..usual }).0));
    let words = thin_strokes(&Figure::Space(drawing.clone()));
    assert_eq!(words.is_some(), told > 100.0, "{words:?}");
}

#[test]
fn meshes_have_the_height_that_is_asked_for() {
    let options = FileOptions { height: 2.0, ..FileOptions::default() };
    let span = |heights: Vec<f64>| {
        let [low, high] = [heights.iter().copied().fold(9e9, f64::min), heights.iter().copied().fold(-9e9, f64::max)];
        assert!((high - low - 2.0).abs() < 1e-4, "{low} to {high}");
    };
    for n in [3, 7] {
        let drawing = drawing(&tree(), n);
        let file = written("glb", drawing.clone(), &options).unwrap();
        let (json, binary) = chunks(&file);
        let scale = numbers(&json["nodes"][0]["scale"])[1];
        span(unfolded(&json, binary).iter().map(|corner| scale * corner[1]).collect());
        let text = String::from_utf8(written("obj", drawing.clone(), &options).unwrap()).unwrap();
        let lines = text.lines().filter_map(|line| line.strip_prefix("v "));
        span(lines.map(|line| line.split(' ').nth(1).unwrap().parse().unwrap()).collect());
        span(heights(&print(&drawing, &tree().style, &options, false)).iter().flatten().map(|&c| c.into()).collect());
    }
}

#[test]
fn bodies_for_openscad_are_closed_and_face_outwards() {
    let file = written("scad", drawing(&tree(), 4), &FileOptions::default()).unwrap();
    let text = String::from_utf8(file).unwrap();
    let mut count = 0;
    for line in text.lines().filter_map(|line| line.strip_prefix("polyhedron(")?.strip_suffix(");")) {
        let [points, faces]: [Vec<Point>; 2] = serde_json::from_str(&format!("[{line}]")).unwrap();
        let mut edges = HashMap::new();
        let mut volume = 0.0;
        for face in &faces {
            let [a, b, c] = face.map(|corner| corner as usize);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry([from.min(to), from.max(to)]).or_insert(0) += if from < to { 1 } else { -1 };
            }
            let [p, q, r] = [a, b, c].map(|corner| points[corner]);
            let cross = [0, 1, 2].map(|i| q[(i + 1) % 3] * r[(i + 2) % 3] - q[(i + 2) % 3] * r[(i + 1) % 3]);
            volume -= (0..3).map(|i| p[i] * cross[i]).sum::<f64>() / 6.0;
        }
        // Faces are clockwise as seen from outside.
        assert!(edges.values().all(|&sum| sum == 0) && volume > 0.0 && points.len() > 3, "{line}");
        count += 1;
    }
    let drawing = drawing(&tree(), 4);
    // A body for each stroke, two for each leaf of four vertices, and the foot.
    let leaves = drawing.polygon_count();
    assert!(count > drawing.segment_count() && count <= drawing.segment_count() + 2 * leaves + 1, "{count}");
}

/// A file: its JSON, and its binary chunk.
fn chunks(file: &[u8]) -> (Value, &[u8]) {
    let number = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&file[..4], number(4), number(8)), (&b"glTF"[..], 2, file.len()));
    let json = &file[20..20 + number(12)];
    assert_eq!((&file[16..20], json.len() % 4), (&b"JSON"[..], 0));
    let rest = 20 + json.len();
    let binary = if rest == file.len() { &[][..] } else { &file[rest + 8..] };
    assert!(binary.is_empty() || (&file[rest + 4..rest + 8] == b"BIN\0" && number(rest) == binary.len()));
    (serde_json::from_slice(json).unwrap(), binary)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().map(|value| value.as_f64().unwrap()).collect()
}

fn index(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

/// The bytes of an accessor, entry by entry.
fn entries<'a>(json: &Value, binary: &'a [u8], accessor: &Value) -> impl Iterator<Item = &'a [u8]> {
    let accessor = &json["accessors"][index(accessor)];
    let view = &json["bufferViews"][index(&accessor["bufferView"])];
    let size = match (accessor["componentType"].as_u64(), accessor["type"].as_str()) {
        (Some(5126), Some("VEC3")) => 12,
        (Some(5123), Some("VEC4")) => 8,
        (Some(5123), Some("SCALAR")) => 2,
        (Some(5125), Some("SCALAR")) => 4,
        other => panic!("{other:?}"),
    };
    let (offset, count) = (index(&accessor["byteOffset"]), index(&accessor["count"]));
    assert!(offset + count * size <= index(&view["byteLength"]) && count > 0);
    assert!(view.get("byteStride").is_none_or(|stride| index(stride) == size));
    binary[index(&view["byteOffset"]) + offset..][..count * size].chunks(size)
}

fn vector(bytes: &[u8]) -> Point {
    [0, 4, 8].map(|at| f64::from(f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())))
}

/// A vector rotated by a unit quaternion.
fn rotated(v: Point, quaternion: &[f64]) -> Point {
    let &[x, y, z, w] = quaternion else { return v };
    let cross =
        |a: Point, b: Point| [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
    let axis = [x, y, z];
    let once = cross(axis, v).map(|c| 2.0 * c);
    let twice = cross(axis, once);
    [0, 1, 2].map(|i| v[i] + w * once[i] + twice[i])
}

/// The corners of a scene with all its nodes.
fn unfolded(json: &Value, binary: &[u8]) -> Vec<Point> {
    let mut corners = vec![];
    let nodes = json["nodes"].as_array().unwrap();
    let children = numbers(&nodes[0]["children"]);
    assert!(children.iter().map(|&child| child as usize).eq(1..nodes.len()));
    for node in &nodes[1..] {
        let (at, rotation) = (numbers(&node["translation"]), numbers(&node["rotation"]));
        for part in json["meshes"][index(&node["mesh"])]["primitives"].as_array().unwrap() {
            let position = &part["attributes"]["POSITION"];
            for corner in entries(json, binary, position).map(vector) {
                let corner = rotated(corner, &rotation);
                corners.push([0, 1, 2].map(|axis| corner[axis] + at.get(axis).unwrap_or(&0.0)));
            }
        }
    }
    corners
}

#[test]
fn quaternions_turn_as_their_rotations() {
    let axes = [Axis::Ahead, Axis::Left, Axis::Up];
    let turns = [0.0, 25.7, 90.0, 179.0, 180.0, 250.0].map(Heading::from_degrees);
    for [a, b] in axes.into_iter().flat_map(|a| axes.map(|b| [a, b])) {
        for (first, second) in turns.into_iter().flat_map(|first| turns.map(|second| (first, second))) {
            let rotation = Rotation::about(a, first).then(&Rotation::about(b, second));
            for vector in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, -0.4, 2.0]] {
                let [expected, found] = [rotation.apply(vector), rotated(vector, &rotation.quaternion())];
                assert!((0..3).all(|i| (expected[i] - found[i]).abs() < 1e-12), "{expected:?} {found:?}");
            }
        }
    }
}

/// Whether each of `points` has one of `others` within `distance`.
fn near(points: &[Point], others: &[Point], distance: f64) -> bool {
    let cell = |point: &Point| point.map(|c| (c / distance).floor() as i64);
    let mut grid = HashMap::<_, Vec<Point>>::new();
    others.iter().for_each(|point| grid.entry(cell(point)).or_default().push(*point));
    let is_near =
        |a: &Point, b: &Point| (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>() <= distance * distance;
    points.iter().all(|point| {
        let [x, y, z] = cell(point);
        (0..27).any(|i| {
            let neighbour = [x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1];
            grid.get(&neighbour).is_some_and(|others| others.iter().any(|other| is_near(point, other)))
        })
    })
}

/// The ends of all segments, the vertices of all polygons, and the greatest width.
fn points(drawing: &Drawing<Solid>) -> (Vec<Point>, f64) {
    let (mut points, mut widest) = (vec![], 0.0_f64);
    for mark in drawing.marks() {
        match mark {
            Mark::Segment(segment, _) => {
                points.extend([segment.from, segment.to]);
                widest = widest.max(segment.width);
            }
            Mark::Polygon(vertices, _) => points.extend(vertices),
        }
    }
    (points, widest)
}

#[test]
fn scenes_of_shared_parts_show_the_whole_drawing() {
    let files =
        [("practical-1/tree3d0", 5), ("abop/1.25", 7), ("abop/2.6a", 12), ("garden/lime-twig", 6), ("abop/1.24a", 5)];
    let mut systems: Vec<_> = files.map(|(name, n)| (definition(&data(&format!("{name}.json"))), n)).into();
    systems.push((tree(), 7));
    for (definition, n) in systems {
        let drawing = drawing(&definition, n);
        let file = write_glb(&drawing, &definition.style, u64::MAX, &definition.name).unwrap();
        let (json, binary) = chunks(&file);
        let [nodes, meshes] = ["nodes", "meshes"].map(|list| json[list].as_array().unwrap().len());
        assert!(nodes > meshes + 10, "{}: {nodes} nodes of {meshes} meshes", definition.name);
        let [low, high] = drawing.bounds().unwrap();
        let extent = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
        let (points, widest) = points(&drawing);
        let width = widest.max(extent * definition.style.min_width.max(0.1) / 1024.0);
        let corners = unfolded(&json, binary);
        // A corner of a bend is at most 1.5 radii from the bend.
        assert!(near(&corners, &points, width), "{}: a corner far from the drawing", definition.name);
        assert!(near(&points, &corners, width), "{}: a part of the drawing is missing", definition.name);
    }
}

#[test]
fn a_scene_keeps_the_rules_of_its_format() {
    let definition = tree();
    let file = write_glb(&drawing(&definition, 7), &definition.style, u64::MAX, "a \"name\"\n").unwrap();
    let (json, binary) = chunks(&file);
    assert_eq!(json["nodes"][0]["name"], "a \"name\" ");
    assert_eq!(json["buffers"][0]["byteLength"], binary.len());
    let mut used = HashSet::new();
    for part in json["meshes"].as_array().unwrap().iter().flat_map(|mesh| mesh["primitives"].as_array().unwrap()) {
        let attributes = &part["attributes"];
        let positions: Vec<Point> = entries(&json, binary, &attributes["POSITION"]).map(vector).collect();
        let accessor = &json["accessors"][index(&attributes["POSITION"])];
        for axis in 0..3 {
            let all = || positions.iter().map(|p| p[axis] as f32);
            let told = |key: &str| accessor[key][axis].as_f64().unwrap() as f32;
            assert_eq!(told("min"), all().fold(f32::INFINITY, f32::min));
            assert_eq!(told("max"), all().fold(f32::NEG_INFINITY, f32::max));
        }
        let normals: Vec<Point> = entries(&json, binary, &attributes["NORMAL"]).map(vector).collect();
        assert_eq!(normals.len(), positions.len());
        assert!(normals.iter().all(|n| (n.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-5));
        let indices: Vec<usize> = entries(&json, binary, &part["indices"])
            .map(|bytes| bytes.iter().rev().fold(0, |index, &byte| index << 8 | usize::from(byte)))
            .collect();
        assert!(indices.len().is_multiple_of(3) && indices.iter().all(|&corner| corner < positions.len()));
        // The triangles face where their normals point.
        for corners in indices.chunks(3) {
            let [a, b, c] = [0, 1, 2].map(|i| positions[corners[i]]);
            let [u, v] = [b, c].map(|to| [0, 1, 2].map(|i| to[i] - a[i]));
            let face = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let outward: f64 = corners
                .iter()
                .flat_map(|&corner| (0..3).map(move |i| (corner, i)))
                .map(|(corner, i)| face[i] * normals[corner][i])
                .sum();
            assert!(outward > 0.0);
        }
        used.insert(index(&part["material"]));
    }
    let materials = json["materials"].as_array().unwrap();
    assert_eq!(used.len(), materials.len());
    // Each colour of the five has a material for strokes and one for leaves, which alone has two sides.
    let count = |kind: &str, sides: Option<bool>| {
        let is_kind = |material: &&Value| material["name"].as_str().unwrap().starts_with(kind);
        materials.iter().filter(is_kind).filter(|material| material["doubleSided"].as_bool() == sides).count()
    };
    assert_eq!((count("Stroke", None), count("Leaf", Some(true)), materials.len()), (5, 5, 10));
    let first = numbers(&materials[0]["pbrMetallicRoughness"]["baseColorFactor"]);
    // The palette's first colour is 1f5c3a; the values are from the formula of sRGB.
    for (value, expected) in first.iter().zip([0.013_702, 0.107_023, 0.042_311, 1.0]) {
        assert!((value - expected).abs() < 1e-5, "{first:?}");
    }
}

#[test]
fn colours_along_the_path_are_at_the_corners() {
    let style = Style { colour_by: lsystem_syntax::ColourBy::Path, ..tree().style };
    let file = write_glb(&drawing(&tree(), 4), &style, u64::MAX, "").unwrap();
    let (json, binary) = chunks(&file);
    let part = &json["meshes"][0]["primitives"][0];
    let colours: HashSet<&[u8]> = entries(&json, binary, &part["attributes"]["COLOR_0"]).collect();
    assert!(colours.len() > 20 && colours.iter().all(|colour| colour[6..] == [0xff, 0xff]));
    assert!(json["materials"][0]["pbrMetallicRoughness"].get("baseColorFactor").is_none());
    let empty = write_glb(&drawing(&Definition { axiom: "X".into(), ..tree() }, 1), &style, 10, "").unwrap();
    assert!(chunks(&empty).0.get("meshes").is_none() && chunks(&empty).1.is_empty());
}

#[test]
fn deep_scenes_are_small() {
    let definition = tree();
    let bytes = |n| write_glb(&drawing(&definition, n), &definition.style, u64::MAX, "").unwrap().len();
    // Each step makes three times as many segments: 1,062,880 at n = 12 without the polygons.
    let [ten, eleven] = [10, 11].map(bytes);
    assert!(eleven < 2 * ten && eleven < 6_000_000, "{ten} {eleven}");
}

/// A file of a mesh.
fn written(format: &str, drawing: Arc<Drawing<Solid>>, options: &FileOptions) -> Result<Vec<u8>, Diagnostic> {
    let Content::Mesh(write) = Format::named(format).unwrap().content else { panic!("{format} is a mesh") };
    collect(|sink| write(drawing, &tree().style, options, sink)).map(|(file, _)| file)
}

#[test]
fn limits_are_told() {
    let definition = tree();
    let kind = |n: u32, most: u64, memory: u64| {
        let options = FileOptions { most, memory, ..FileOptions::default() };
        written("glb", drawing(&definition, n), &options).unwrap_err().kind
    };
    let limit =
        |kind: Kind| if let Kind::Limit { limit, value, .. } = kind { (limit, value) } else { panic!("{kind:?}") };
    assert_eq!(limit(kind(40, u64::MAX, u64::MAX)), (LimitName::MeshCopies, MAX_MESH_COPIES));
    assert_eq!(limit(kind(4, 100, u64::MAX)), (LimitName::Mesh, 100));
    assert_eq!(limit(kind(8, 100, u64::MAX)).0, LimitName::Mesh);
    assert_eq!(limit(kind(8, u64::MAX, 10_000)).0, LimitName::Memory);
}

#[test]
fn fine_parts_become_one_tube_each() {
    let definition = tree();
    let whole = drawing(&definition, 9);
    let simple = whole.simplified(0.1, u64::MAX, &mut Meter::new(0)).unwrap();
    let [before, after] = [&whole, &simple].map(Drawing::segment_count);
    assert!(after > 10 && 3 * after < before, "{before} {after}");
    let [low, high] = whole.bounds().unwrap();
    let finest = 0.1 * (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    // The ends of a tube lie in the box of what it stands for.
    let distance = finest * 3.0_f64.sqrt();
    let [(whole_points, _), (simple_points, _)] = [points(&whole), points(&simple)];
    assert!(near(&simple_points, &whole_points, distance) && near(&whole_points, &simple_points, distance));
    // Nothing is fine where nothing is smaller than 0.
    let same = whole.simplified(0.0, u64::MAX, &mut Meter::new(0)).unwrap();
    assert!(same.segments().eq(whole.segments()) && same.polygon_count() == whole.polygon_count());
    let error = whole.simplified(0.0, 1000, &mut Meter::new(0)).unwrap_err().diagnostic();
    assert!(matches!(error.kind, Kind::Limit { limit: LimitName::Memory, .. }));
}

#[test]
fn a_drawing_of_any_depth_has_a_simple_mesh() {
    let definition = tree();
    for format in ["glb", "stl", "obj", "scad"] {
        let options = FileOptions { finest: 0.1, most: 50_000, ..FileOptions::default() };
        let file = written(format, drawing(&definition, 40), &options).unwrap();
        assert!(file.len() > 10_000, "{format}: {}", file.len());
        if format == "stl" {
            assert!(edges(&file).values().all(|&count| count == [1, 1]));
        }
        let refused = written(format, drawing(&definition, 40), &FileOptions::default());
        assert!(refused.is_err_and(|error| matches!(error.kind, Kind::Limit { .. })));
    }
}
