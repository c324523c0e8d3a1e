/** Plays notes: each is a tone of its own that begins softly and fades. */

/** The loudest tone; many sound at once. */
const PEAK = 0.22;
/** The time in which a tone begins, that in which it fades, and that in which it ends, in seconds. */
const [ATTACK, FADE, RELEASE] = [0.008, 0.25, 0.03];

/** The frequency of a key of the MIDI standard, in Hertz. @param {number} key */
export const frequencyOf = (key) => 440 * 2 ** ((key - 69) / 12);

/** Browsers let a page sound only after a button was pressed. @param {BaseAudioContext} context */
export function createInstrument(context) {
    const volume = context.createGain();
    const limiter = context.createDynamicsCompressor();
    volume.connect(limiter).connect(context.destination);
    let bus = start();

    function start() {
        const next = context.createGain();
        next.connect(volume);
        return next;
    }

    return {
        /** Seconds since the context was made. */
        get now() {
            return context.currentTime;
        },

        /** @param {Pick<import('../protocol.js').Note, 'key' | 'velocity' | 'side'>} note @param {number} at seconds, as `now` @param {number} seconds */
        play({ key, velocity, side }, at, seconds) {
            const [tone, pan, loudness] = [
                context.createOscillator(),
                context.createStereoPanner(),
                context.createGain(),
            ];
            const [peak, end] = [(PEAK * velocity) / 127, at + Math.max(seconds, 2 * ATTACK)];
            tone.type = 'triangle';
            tone.frequency.value = frequencyOf(key);
            pan.pan.value = 0.8 * side;
            loudness.gain.setValueAtTime(0, at);
            loudness.gain.linearRampToValueAtTime(peak, at + ATTACK);
            loudness.gain.setTargetAtTime(peak / 3, at + ATTACK, FADE);
            loudness.gain.setTargetAtTime(0, end, RELEASE);
            tone.connect(pan).connect(loudness).connect(bus);
            tone.start(at);
            tone.stop(end + 6 * RELEASE);
        },

        /** @param {number} part from 0 to 1; heard in equal steps */
        setVolume(part) {
            volume.gain.setTargetAtTime(part ** 2, context.currentTime, RELEASE);
        },

        /** Ends all notes, also those to come. */
        hush() {
            const last = bus;
            last.gain.setTargetAtTime(0, context.currentTime, RELEASE);
            setTimeout(() => last.disconnect(), 10_000 * RELEASE);
            bus = start();
        },
    };
}
