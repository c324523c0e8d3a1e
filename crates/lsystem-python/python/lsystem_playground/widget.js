/** The widget's frame: embed.html, from the package or from an address. docs/embedding.md describes its messages. */

/** Traits that are numbers of the drawing. */
const NUMBERS = ['n', 'angle', 'seed'];
/** A frame that has not greeted after this time is refused by the notebook's policy, in milliseconds. */
const PATIENCE = 15000;

/** The bytes that Python sends for a word. */
function ask(model, word) {
    return new Promise((resolve) => {
        const hear = (message, buffers) => {
            if (message !== word) return;
            model.off('msg:custom', hear);
            const { buffer, byteOffset, byteLength } = buffers[0];
            resolve(new Uint8Array(buffer ?? buffers[0], byteOffset ?? 0, byteLength ?? buffers[0].byteLength));
        };
        model.on('msg:custom', hear);
        model.send(word);
    });
}

/** The address of the page. */
async function address(model) {
    const base = model.get('base');
    if (base) return new URL('embed.html', base.endsWith('/') ? base : `${base}/`).href;
    const unpacked = new Blob([await ask(model, 'page')]).stream().pipeThrough(new DecompressionStream('gzip'));
    const page = await new Response(unpacked).arrayBuffer();
    return URL.createObjectURL(new Blob([page], { type: 'text/html' }));
}

/** Whether what is behind the widget is dark. */
function isDark(el) {
    for (let element = el; element; element = element.parentElement ?? element.getRootNode().host) {
        const [r, g, b, a = 1] = (getComputedStyle(element).backgroundColor.match(/[\d.]+/g) ?? []).map(Number);
        if (a > 0.5) return 0.3 * r + 0.59 * g + 0.11 * b < 128;
    }
    return false;
}

async function render({ model, el }) {
    const frame = document.createElement('iframe');
    frame.title = 'L-system';
    frame.allow = 'clipboard-write';
    const resize = () => {
        frame.style.cssText = `display: block; width: 100%; height: ${model.get('height')}px; border: 0`;
    };
    resize();
    el.replaceChildren(frame);

    /** Messages of Python that the frame cannot hear yet. */
    let waiting = [];
    let isGreeted = false;
    const say = (message) => {
        if (isGreeted) frame.contentWindow?.postMessage(message, '*');
        else waiting.push(message);
    };
    const theme = () => model.get('theme') || (isDark(el) ? 'dark' : 'light');

    const hear = ({ data, source }) => {
        if (source !== frame.contentWindow || typeof data?.lsystem !== 'string') return;
        if (data.lsystem === 'hello') {
            isGreeted = true;
            clearTimeout(refused);
            for (const message of [{ lsystem: 'hello' }, ...waiting]) say(message);
            waiting = [];
            return;
        }
        if (data.values) {
            for (const name of NUMBERS) model.set(name, data.values[name]);
            model.set('link', data.link);
        }
        model.set('error', data.lsystem === 'error' ? data.message : '');
        model.save_changes();
    };
    addEventListener('message', hear);

    const listeners = {
        'msg:custom': (message) => message.lsystem && say(message),
        'change:controls': () => say({ lsystem: 'controls', controls: model.get('controls') }),
        'change:theme': () => say({ lsystem: 'theme', theme: theme() }),
        'change:height': resize,
    };
    for (const [event, listener] of Object.entries(listeners)) model.on(event, listener);

    /** A still picture, where the notebook allows no such frame. */
    const still = async () => {
        clearTimeout(refused);
        const image = new Image();
        image.alt = 'L-system';
        image.style.cssText = `max-width: 100%; max-height: ${model.get('height')}px`;
        const draw = async () => {
            let text = '';
            for (const byte of await ask(model, 'picture')) text += String.fromCharCode(byte);
            image.src = `data:image/png;base64,${btoa(text)}`;
        };
        for (const name of [...NUMBERS, 'link']) model.on(`change:${name}`, draw);
        await draw();
        el.replaceChildren(image);
    };
    let refused = 0;
    const violated = (event) => {
        if (!isGreeted && /^(frame|child)-src/.test(event.effectiveDirective)) still();
    };
    document.addEventListener('securitypolicyviolation', violated);

    const home = await address(model);
    refused = setTimeout(still, PATIENCE);
    const fields = NUMBERS.map((name) => [name, model.get(name)]);
    fields.push(['controls', model.get('controls').join(',')], ['theme', theme()]);
    // The package has no playground to open.
    if (!model.get('base')) fields.push(['away', 0]);
    const own = new URLSearchParams(fields);
    frame.src = `${home}${model.get('link') || '#v=1'}&${own}`;

    return () => {
        clearTimeout(refused);
        removeEventListener('message', hear);
        document.removeEventListener('securitypolicyviolation', violated);
        for (const [event, listener] of Object.entries(listeners)) model.off(event, listener);
        if (home.startsWith('blob:')) URL.revokeObjectURL(home);
    };
}

export default { render };
