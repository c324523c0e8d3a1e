/**
 * <l-system axiom="X" angle="25" n="5" controls="angle,n">X -> F[+X]-X</l-system>: a live drawing in any page. The text
 * may also give the fields, on lines such as `axiom: X` above the rules.
 *
 * The script is built into one classic script, because other sites may not import our modules. The drawing is
 * embed.html in an iframe, from the folder of this script. Attributes are sent to the frame as messages, and its
 * messages become events. docs/embedding.md describes the element.
 */
import { declaredScheme, schemeOf, systemIsDark } from './js/embed/scheme.js';
import { ATTRIBUTES } from './js/tables.js';

(() => {
    const script = document.currentScript;
    /** The page of the drawing, or the one that also has exercises and steps. @param {string} [link] */
    const home = (link = '') =>
        new URL(
            /(^|[#&])x=|&controls=[^&]*steps/.test(link) ? 'exercise.html' : 'embed.html',
            script instanceof HTMLScriptElement && script.src ? script.src : location.href,
        );
    const HOME = home();
    /** Pages from a disk have no distinct origin. */
    const ORIGIN = HOME.protocol === 'file:' ? null : HOME.origin;

    const system = systemIsDark();

    /** Attributes that are values of the drawing, and their link keys. */
    const KEYS = new Map(Object.entries(ATTRIBUTES));
    /** The names of labelled lines, and their keys: attributes, keys in links, and those of the frame. @type {Map<string, string>} */
    const LABELS = new Map(KEYS);
    for (const key of [...KEYS.values(), 'controls', 'theme']) LABELS.set(key, key);
    /** Fields that `auto` chooses: a text that gives one of them has the look that it says. */
    const LOOK = ['auto', 'colour', 'width', 'thinner'];
    /** Changes within this time are sent together, in milliseconds. */
    const PAUSE = 40;

    const STYLE = `
        :host { display: block; aspect-ratio: 4 / 3; min-height: 12rem; contain: content; }
        :host([hidden]) { display: none; }
        iframe { display: block; width: 100%; height: 100%; border: 0; }
        @media print { :host { break-inside: avoid; } }`;

    class LSystem extends HTMLElement {
        static observedAttributes = ['link', 'controls', 'theme', 'loading', ...KEYS.keys()];

        /** @type {HTMLIFrameElement | null} */
        #frame = null;
        /** The values that were sent to the frame, by key. @type {Record<string, string>} */
        #sent = {};
        #timer = 0;
        /** Whether the frame receives messages, and the messages queued until then. */
        #connected = false;
        /** @type {object[]} */
        #queue = [];
        #ready = false;
        #lastId = 0;
        /** @type {Map<number, (state: Record<string, unknown>) => void>} */
        #pending = new Map();
        /** The last state from the frame. @type {{values: Record<string, unknown>, link: string} | null} */
        #state = null;
        #observer = new MutationObserver(() => this.#changed());
        /** The theme that was sent to the frame. */
        #theme = '';
        /** The controls that were sent to the frame. */
        #controls = '';
        /** Host pages switch their scheme with an attribute of their root or body. */
        #schemes = new MutationObserver(() => this.#recolour());

        connectedCallback() {
            addEventListener('message', this.#hear);
            this.#observer.observe(this, { childList: true, characterData: true, subtree: true });
            for (const element of [document.documentElement, document.body])
                this.#schemes.observe(element, { attributes: true });
            system.addEventListener('change', this.#recolour);
            // While the page loads, the element's text is not parsed yet.
            if (document.readyState === 'loading')
                document.addEventListener('DOMContentLoaded', this.#build, { once: true });
            else queueMicrotask(this.#build);
        }

        disconnectedCallback() {
            removeEventListener('message', this.#hear);
            document.removeEventListener('DOMContentLoaded', this.#build);
            this.#observer.disconnect();
            this.#schemes.disconnect();
            system.removeEventListener('change', this.#recolour);
            clearTimeout(this.#timer);
            this.#frame?.remove();
            this.#frame = null;
            this.#ready = false;
            this.#connected = false;
        }

        /** @param {string} name @param {string | null} before @param {string | null} now */
        attributeChangedCallback(name, before, now) {
            if (before === now || !this.#frame) return;
            if (name === 'link') this.#load();
            else if (name === 'theme') this.#recolour();
            else if (name === 'controls') this.#showControls();
            else if (name === 'loading') this.#frame.loading = now === 'eager' ? 'eager' : 'lazy';
            else this.#changed();
        }

        /** The current values of the drawing, by link keys. Null before the first message. */
        get values() {
            return this.#state?.values ?? null;
        }

        /** The current drawing as the hash of a link, with the `#`. Null before the first message. */
        get state() {
            return this.#state?.link ?? null;
        }

        /** Whether the first picture is shown. */
        get ready() {
            return this.#ready;
        }

        /**
         * Sets values by link keys, as attributes do.
         * @param {Record<string, unknown>} values
         */
        set(values) {
            this.#say({ lsystem: 'set', values });
        }

        /** Opens another drawing. @param {string} link an address of the playground, or its hash */
        open(link) {
            this.#say({ lsystem: 'open', link: hashOf(link) });
        }

        /** Undoes the visitor's changes. */
        reset() {
            this.#say({ lsystem: 'reset' });
        }

        play() {
            this.#say({ lsystem: 'play' });
        }

        pause() {
            this.#say({ lsystem: 'pause' });
        }

        /** The current state, a description, and the exact numbers of symbols and segments. @returns {Promise<Record<string, unknown>>} */
        get() {
            return new Promise((resolve) => {
                const id = ++this.#lastId;
                this.#pending.set(id, resolve);
                this.#say({ lsystem: 'get', id });
            });
        }

        focus() {
            this.#frame?.focus();
        }

        #build = () => {
            if (!this.isConnected || this.#frame) return;
            const root = this.shadowRoot ?? this.attachShadow({ mode: 'open' });
            // A style element might be refused by the page's content security policy.
            const style = new CSSStyleSheet();
            style.replaceSync(STYLE);
            root.adoptedStyleSheets = [style];
            this.#frame = document.createElement('iframe');
            this.#frame.loading = this.getAttribute('loading') === 'eager' ? 'eager' : 'lazy';
            this.#frame.allow = 'clipboard-write';
            this.#frame.part = 'frame';
            root.replaceChildren(this.#frame);
            this.#load();
        };

        /** The theme that is asked for, or else the host page's. */
        #themeNow() {
            const asked = this.getAttribute('theme') ?? labelled(textIn(this)).theme;
            return asked === 'light' || asked === 'dark' ? asked : schemeOf(declaredScheme(this), system.matches);
        }

        #recolour = () => {
            const theme = this.#themeNow();
            if (!this.#frame || theme === this.#theme) return;
            this.#theme = theme;
            this.#say({ lsystem: 'theme', theme });
        };

        #controlsNow() {
            return this.getAttribute('controls') ?? labelled(textIn(this)).controls ?? '';
        }

        #showControls() {
            const controls = this.#controlsNow();
            if (controls === this.#controls) return;
            this.#controls = controls;
            this.#say({ lsystem: 'controls', controls });
        }

        /** Sets the frame's address, which contains all values. */
        #load() {
            if (!this.#frame) return;
            this.#sent = this.#attributeValues();
            const name = this.getAttribute('aria-label') ?? this.#sent.title;
            this.#frame.title = name ? `L-system: ${name}` : 'L-system';
            const link = hashOf(this.getAttribute('link') ?? '').replace(/^#/, '');
            this.#theme = this.#themeNow();
            this.#controls = this.#controlsNow();
            const fields = {
                ...this.#sent,
                controls: this.#controls,
                theme: this.#theme,
                host: location.origin === 'null' ? '' : location.origin,
            };
            const own = Object.entries(fields).flatMap(([key, value]) =>
                value === '' ? [] : [`${key}=${encodeURIComponent(value)}`],
            );
            const hash = [link || 'v=1', ...own].join('&');
            const address = home(hash);
            address.hash = hash;
            // Later addresses replace the former one, to keep the page's history clean.
            if (this.#connected) this.#frame.contentWindow?.location.replace(address.href);
            else this.#frame.src = address.href;
        }

        /** The values of attributes and text, as strings. @returns {Record<string, string>} */
        #attributeValues() {
            const values = Object.fromEntries(
                [...KEYS].flatMap(([name, key]) =>
                    this.hasAttribute(name) ? [[key, this.getAttribute(name) ?? '']] : [],
                ),
            );
            if (values.rules === undefined) {
                const { controls: _, theme: __, ...fields } = labelled(textIn(this));
                for (const [key, value] of Object.entries(fields)) if (value !== '') values[key] ??= value;
                // A text with an axiom stands for a whole system, which is drawn as the playground opens it.
                if (fields.axiom !== undefined && !LOOK.some((key) => key in values)) values.auto = '1';
            }
            // Links write colours without `#`.
            for (const key of ['bg', 'palette'])
                if (values[key] !== undefined) values[key] = values[key].replace(/[#\s]/g, '');
            return values;
        }

        /** Sends changed values to the frame, after a pause. */
        #changed() {
            if (!this.#frame) return;
            clearTimeout(this.#timer);
            this.#timer = window.setTimeout(() => {
                this.#showControls();
                const given = this.#attributeValues();
                // A removed attribute returns to its default, which needs a new address.
                if (Object.keys(this.#sent).some((key) => !(key in given))) return this.#load();
                const values = Object.fromEntries(
                    Object.entries(given).filter(([key, value]) => this.#sent[key] !== value),
                );
                this.#sent = given;
                if (Object.keys(values).length > 0) this.#say({ lsystem: 'set', values });
            }, PAUSE);
        }

        /** @param {object} message */
        #say(message) {
            if (this.#connected && this.#frame?.contentWindow)
                this.#frame.contentWindow.postMessage(message, ORIGIN ?? '*');
            else this.#queue.push(message);
        }

        /** @param {MessageEvent} event */
        #hear = (event) => {
            const { data, source, origin } = event;
            if (!this.#frame || source !== this.#frame.contentWindow || (ORIGIN !== null && origin !== ORIGIN)) return;
            if (typeof data !== 'object' || data === null || typeof data.lsystem !== 'string') return;
            const { lsystem: kind, ...detail } = data;
            if (kind === 'hello') {
                this.#connected = true;
                // This message tells the frame the origin to answer.
                this.#say({ lsystem: 'hello' });
                const waiting = this.#queue;
                this.#queue = [];
                for (const message of waiting) this.#say(message);
                return;
            }
            if (detail.values) this.#state = { values: detail.values, link: detail.link };
            if (kind === 'height') {
                // An exercise is as high as it needs, unless the page says otherwise.
                if (typeof detail.height === 'number' && !this.style.height)
                    this.#frame.style.height = this.style.minHeight = `${Math.ceil(detail.height)}px`;
                return;
            }
            if (kind === 'state') {
                this.#pending.get(detail.id)?.(detail);
                this.#pending.delete(detail.id);
            } else if (kind === 'ready' || kind === 'change' || kind === 'mark' || kind === 'error') {
                if (kind === 'ready') this.#ready = true;
                this.dispatchEvent(new CustomEvent(kind, { detail }));
            }
        };
    }

    /** The hash of an address. @param {string} address */
    function hashOf(address) {
        return address.includes('#') ? address.slice(address.indexOf('#')) : address;
    }

    /** The text of a `pre` in the element, which is also shown without JavaScript, or else the element's own text. @param {HTMLElement} element */
    function textIn(element) {
        const own = [...element.childNodes]
            .filter((node) => node.nodeType === Node.TEXT_NODE)
            .map((node) => node.textContent ?? '');
        return element.querySelector('pre')?.textContent ?? own.join('\n');
    }

    /**
     * The rules of a text, and the fields on labelled lines above them, such as `n: 6`. The core reads the same texts
     * (crates/lsystem-import/src/labelled.rs).
     * @param {string} text
     * @returns {Record<string, string>} by link keys
     */
    function labelled(text) {
        const lines = text.split('\n').map((line) => line.trim());
        const rules = lines.filter((line) => line !== '');
        /** @type {Record<string, string>} */
        const fields = {};
        for (;;) {
            const [, name = '', value = ''] = rules[0]?.match(/^([a-z]+):\s*(.*)$/) ?? [];
            const key = LABELS.get(name);
            if (key) rules.shift();
            if (key === 'rules' && value !== '') rules.unshift(value);
            if (!key || (key === 'rules' && value !== '')) return { ...fields, rules: rules.join('\n') };
            // Custom symbols are lines; of any other field, the last value counts.
            if (key !== 'rules') fields[key] = key === 'do' && fields.do ? `${fields.do}\n${value}` : value;
        }
    }

    if (!customElements.get('l-system')) customElements.define('l-system', LSystem);
})();
