//! Photographs of drawings, made from the outside in: the light of each pixel is followed back through the lens to the
//! paper. Every fault is a number, and chance comes from a seed.

/// Where a drawing is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scene {
    /// A printed page on a dark table, all of it in the picture.
    Page,
    /// A printed page that is larger than the picture.
    Close,
    /// A slide on a screen, in a dark room.
    Slide,
    /// A scan: a page that lies a little askew on the glass, without perspective or shadow.
    Scan,
    /// Chalk on a board that is larger than the picture.
    Board,
}

pub(crate) const SCENES: [Scene; 5] = [Scene::Page, Scene::Close, Scene::Slide, Scene::Scan, Scene::Board];

/// The faults of a photograph. Lengths are in pixels, angles in degrees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Faults {
    pub(crate) scene: Scene,
    /// How far the camera is tilted, and in which direction.
    pub(crate) tilt: f64,
    pub(crate) towards: f64,
    pub(crate) roll: f64,
    /// The part of the light that is lost in the darkest corner, and in the shadow.
    pub(crate) dark: f64,
    pub(crate) shadow: f64,
    /// The standard deviations of the paper's grain and of the lens's blur.
    pub(crate) grain: f64,
    pub(crate) blur: f64,
    pub(crate) jpeg: u8,
    /// The focal length as a part of the picture's width.
    pub(crate) focal: f64,
    pub(crate) seed: u64,
}

pub(crate) const WIDTH: usize = 1600;
pub(crate) const HEIGHT: usize = 1200;
/// The width of a line.
pub(crate) const LINE: f64 = 4.0;
/// How far the page is away: at 1 it is seen in its own size.
const FAR: f64 = 1.15;
/// The places of a pixel that are looked at, each way.
const PLACES: usize = 2;

/// Numbers by chance (Steele et al., SplitMix64).
pub(crate) struct Chance(pub u64);

impl Chance {
    pub(crate) fn part(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut at = self.0;
        at = (at ^ (at >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        at = (at ^ (at >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((at ^ (at >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.part() * (high - low)
    }

    /// Nearly normal, with deviation 1: the sum of twelve.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.part()).sum::<f64>() - 6.0
    }
}

impl Faults {
    /// The faults of one photograph of a scene.
    pub(crate) fn of(scene: Scene, seed: u64) -> Self {
        let mut chance = Chance(seed);
        let is_scan = scene == Scene::Scan;
        Self {
            scene,
            tilt: if is_scan { 0.0 } else { chance.between(8.0, 25.0) },
            towards: chance.between(0.0, 360.0),
            roll: if is_scan { chance.between(-2.0, 2.0) } else { chance.between(-5.0, 5.0) },
            dark: if is_scan { 0.05 } else { chance.between(0.2, 0.5) },
            shadow: if is_scan { 0.0 } else { chance.between(0.0, 0.4) },
            grain: chance.between(3.0, 7.0),
            blur: chance.between(0.8, 1.4),
            jpeg: 40,
            focal: chance.between(0.75, 1.2),
            seed,
        }
    }

    /// The levels of grey of the photograph of segments, as a JPEG file gives them back.
    pub(crate) fn photograph(&self, segments: &[[f64; 4]]) -> Vec<u8> {
        let page = Page::of(segments, self.scene);
        let seen = self.rotation();
        let mut light = vec![0.0; WIDTH * HEIGHT];
        for (at, value) in light.iter_mut().enumerate() {
            let (x, y) = (at % WIDTH, at / WIDTH);
            let mut sum = 0.0;
            for place in 0..PLACES * PLACES {
                let off = |number: usize| (number as f64 + 0.5) / PLACES as f64;
                let ray = [x as f64 + off(place % PLACES), y as f64 + off(place / PLACES)];
                sum += page.level(self.on_page(&seen, ray));
            }
            *value = sum / (PLACES * PLACES) as f64 * self.lit(x as f64, y as f64);
        }
        let mut light = blurred(&light, self.blur);
        let mut chance = Chance(self.seed ^ 0xabcd);
        // Grain is a little larger than a pixel.
        let grain: Vec<f64> = light.iter().map(|_| chance.normal()).collect();
        let grain = blurred(&grain, 0.6);
        light.iter_mut().zip(&grain).for_each(|(value, grain)| *value += 2.0 * self.grain * grain);
        encoded(&light, self.jpeg)
    }

    /// The way from the picture to the page: the camera's rotation.
    fn rotation(&self) -> [[f64; 3]; 3] {
        let (sin, cos) = libm::sincos(self.tilt.to_radians());
        let (up, right) = libm::sincos(self.towards.to_radians());
        let (turn, straight) = libm::sincos(self.roll.to_radians());
        // Turned about an axis in the picture (Rodrigues), then about the line of sight.
        let (x, y) = (-up, right);
        let rest = 1.0 - cos;
        let tilt = [
            [cos + x * x * rest, x * y * rest, y * sin],
            [x * y * rest, cos + y * y * rest, -x * sin],
            [-y * sin, x * sin, cos],
        ];
        let roll = [[straight, -turn, 0.0], [turn, straight, 0.0], [0.0, 0.0, 1.0]];
        let entry = |row: usize, column: usize| (0..3).map(|at| tilt[row][at] * roll[at][column]).sum();
        [0, 1, 2].map(|row| [0, 1, 2].map(|column| entry(row, column)))
    }

    /// The place on the page that a place of the picture shows, in pixels from the middle of the page, which is the
    /// middle of the picture.
    fn on_page(&self, seen: &[[f64; 3]; 3], [x, y]: [f64; 2]) -> [f64; 2] {
        let focal = self.focal * WIDTH as f64;
        let ray = [x - WIDTH as f64 / 2.0, y - HEIGHT as f64 / 2.0, focal];
        let along = |column: usize, way: [f64; 3]| (0..3).map(|at| seen[at][column] * way[at]).sum::<f64>();
        // Where the ray meets the plane through the middle.
        let far = FAR * focal * seen[2][2] / along(2, ray);
        let met = [ray[0] * far, ray[1] * far, ray[2] * far - FAR * focal];
        [along(0, met), along(1, met)]
    }

    /// The part of the light that falls on a place: less towards one corner, and less in a soft shadow.
    fn lit(&self, x: f64, y: f64) -> f64 {
        let mut chance = Chance(self.seed ^ 0x5eed);
        let (sin, cos) = libm::sincos(chance.between(0.0, std::f64::consts::TAU));
        let along = ((x / WIDTH as f64 - 0.5) * cos + (y / HEIGHT as f64 - 0.5) * sin) / std::f64::consts::SQRT_2 + 0.5;
        let (sin, cos) = libm::sincos(chance.between(0.0, std::f64::consts::TAU));
        let place = (x - WIDTH as f64 / 2.0) * cos + (y - HEIGHT as f64 / 2.0) * sin - chance.between(-200.0, 200.0);
        let shadow = 0.5 + 0.5 * libm::tanh(place / 60.0);
        (1.0 - self.dark * along) * (1.0 - self.shadow * shadow)
    }
}

/// A page with a drawing, as levels of grey around its middle.
struct Page {
    ink: Vec<u8>,
    wide: usize,
    high: usize,
    /// The levels of ink, paper and what is around it.
    levels: [f64; 3],
}

/// The pixels of a step on a page, and the middle of a drawing in steps.
pub(crate) fn unit(segments: &[[f64; 4]]) -> (f64, [f64; 2]) {
    let places = || segments.iter().flat_map(|&[a, b, c, d]| [[a, b], [c, d]]);
    let range = |axis: usize| {
        let low = places().map(|at| at[axis]).fold(f64::INFINITY, f64::min);
        (low, places().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max) - low)
    };
    let [(left, across), (low, up)] = [range(0), range(1)];
    ((850.0 / across).min(650.0 / up), [left + across / 2.0, low + up / 2.0])
}

impl Page {
    fn of(segments: &[[f64; 4]], scene: Scene) -> Self {
        let (levels, [wide, high]) = match scene {
            Scene::Page => ([40.0, 225.0, 70.0], [1190, 842]),
            Scene::Close | Scene::Scan => ([40.0, 225.0, 225.0], [2600, 2600]),
            Scene::Slide => ([50.0, 235.0, 25.0], [1152, 864]),
            Scene::Board => ([205.0, 62.0, 62.0], [2600, 2600]),
        };
        let (unit, middle) = unit(segments);
        let place =
            |x: f64, y: f64| [wide as f64 / 2.0 + (x - middle[0]) * unit, high as f64 / 2.0 - (y - middle[1]) * unit];
        let mut page = Self { ink: vec![0; 4 * wide * high], wide, high, levels };
        for &[a, b, c, d] in segments {
            page.stroke(place(a, b), place(c, d));
        }
        page
    }

    /// Draws a line at twice the resolution of a pixel.
    fn stroke(&mut self, from: [f64; 2], to: [f64; 2]) {
        let [[x1, y1], [x2, y2]] = [from, to].map(|at| at.map(|along| along * 2.0));
        let (dx, dy) = (x2 - x1, y2 - y1);
        for y in (y1.min(y2) - LINE) as usize..=(y1.max(y2) + LINE) as usize {
            for x in (x1.min(x2) - LINE) as usize..=(x1.max(x2) + LINE) as usize {
                let (px, py) = (x as f64 + 0.5 - x1, y as f64 + 0.5 - y1);
                let along = ((px * dx + py * dy) / (dx * dx + dy * dy).max(1e-9)).clamp(0.0, 1.0);
                if libm::hypot(px - along * dx, py - along * dy) <= LINE {
                    self.ink[y * 2 * self.wide + x] = 1;
                }
            }
        }
    }

    fn level(&self, [x, y]: [f64; 2]) -> f64 {
        let (x, y) = (2.0 * x + self.wide as f64, 2.0 * y + self.high as f64);
        if x < 0.0 || y < 0.0 || x >= (2 * self.wide) as f64 || y >= (2 * self.high) as f64 {
            return self.levels[2];
        }
        self.levels[1 - usize::from(self.ink[y as usize * 2 * self.wide + x as usize])]
    }
}

/// Values of a picture, blurred by a bell curve.
fn blurred(values: &[f64], deviation: f64) -> Vec<f64> {
    let far = libm::ceil(3.0 * deviation) as i64;
    let weights: Vec<f64> =
        (-far..=far).map(|at| libm::exp(-((at * at) as f64) / (2.0 * deviation * deviation))).collect();
    let sum: f64 = weights.iter().sum();
    let along = |values: &[f64], across: bool| -> Vec<f64> {
        let value = |at: usize| {
            let (x, y) = ((at % WIDTH) as i64, (at / WIDTH) as i64);
            let near = |by: i64| {
                let (x, y) = if across { (x + by, y) } else { (x, y + by) };
                values[y.clamp(0, HEIGHT as i64 - 1) as usize * WIDTH + x.clamp(0, WIDTH as i64 - 1) as usize]
            };
            (-far..=far).zip(&weights).map(|(by, weight)| near(by) * weight).sum::<f64>() / sum
        };
        (0..WIDTH * HEIGHT).map(value).collect()
    };
    along(&along(values, true), false)
}

/// Levels of grey that have been a JPEG file.
fn encoded(light: &[f64], quality: u8) -> Vec<u8> {
    let levels: Vec<u8> = light.iter().map(|value| value.clamp(0.0, 255.0).round() as u8).collect();
    let mut file = Vec::new();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut file, quality);
    encoder.encode(&levels, WIDTH as u32, HEIGHT as u32, image::ExtendedColorType::L8).expect("a JPEG");
    image::load_from_memory(&file).expect("a picture").into_luma8().into_raw()
}
