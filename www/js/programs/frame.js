/**
 * The frame in which programs of students run: a sandbox of no origin, with a policy of its own that allows nothing but
 * scripts and wasm that the page hands over. Each run has a worker of its own in it, which the page can end.
 */

/**
 * The script of the frame. It keeps the interpreter's files, and the memory of a started interpreter (only of one that
 * has not heard of any program yet), and hands them to each worker; texts that are too long stay here. Its hash stands in the policy of `program.html`.
 */
export const BOOT = `let kept={},worker=null,told=false;const urls={};
onmessage=async({data:{id,keep,script,first,tell}})=>{
if(keep){const{wasm,...rest}=keep;kept={...rest,module:await WebAssembly.compile(wasm)};parent.postMessage({id},"*");return}
if(tell){told=true;worker?.postMessage(tell);return}
worker?.terminate();worker=null;if(!script)return;
urls[script]??=URL.createObjectURL(new Blob([script],{type:"text/javascript"}));
const own=worker=new Worker(urls[script]);told=false;
own.onmessage=({data})=>{if(own!==worker||[data.value,data.printed].some((text)=>text?.length>9e6))return;if(data.snapshot){if(!told)kept.snapshot=data.snapshot}else parent.postMessage({id,said:data},"*")};
own.onerror=(event)=>{event.preventDefault();if(own===worker)parent.postMessage({id,said:{crash:event.message}},"*")};
own.postMessage({...first,...(first.python?kept:{})})};
parent.postMessage({ready:true},"*");`;

/** The hash of {@link BOOT}. */
export const HASH = 'sha256-gLZtm95lPDOxTIHG/SF21PbkxAnP/nPmldHm8UvTD2U=';

/** What the frame and its workers may do: no requests, no storage, no evaluated texts. */
const POLICY = `default-src 'none'; script-src '${HASH}' blob: 'wasm-unsafe-eval'; worker-src blob:`;

/** The word stands in no script as a whole: that of a single file would end there. */
const TAG = ['scr', 'ipt'].join('');

/**
 * A frame. `heard` gets what the worker with this number says.
 * @param {(id: number, said: any) => void} heard
 */
export function createFrame(heard) {
    const frame = document.createElement('iframe');
    frame.setAttribute('sandbox', 'allow-scripts');
    frame.title = '';
    frame.hidden = true;
    frame.srcdoc = `<!doctype html><meta http-equiv="Content-Security-Policy" content="${POLICY}"><${TAG}>${BOOT}</${TAG}>`;
    /** @type {(value?: unknown) => void} */
    let begin = () => {};
    const ready = new Promise((resolve) => (begin = resolve));
    addEventListener('message', ({ source, data }) => {
        if (source === null || source !== frame.contentWindow) return;
        if (data.ready) begin();
        else heard(data.id, data.said);
    });
    document.body.append(frame);
    return {
        /** @param {object} message */
        async send(message) {
            await ready;
            frame.contentWindow?.postMessage(message, '*');
        },
    };
}
