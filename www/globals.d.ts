/** The name of the version, which the build writes in front of service-worker.js. */
declare const BUILD: string;
/** The SHA-256 of each file, by its path. */
declare const FILES: Record<string, string>;
/** The size of each file in bytes, by its path. */
declare const SIZES: Record<string, number>;
/** The paths of the files that the first screen needs. */
declare const FIRST: string[];
/** The paths of the files that the page fetches after its first picture. */
declare const SOON: string[];

/** Files that an installed page is asked to open. */
interface Window {
    readonly launchQueue?: {
        setConsumer(consumer: (launched: { readonly files: readonly FileSystemFileHandle[] }) => void): void;
    };
}

/** Files that esbuild bundles as texts. */
declare module '*.html' {
    const text: string;
    export default text;
}
declare module '*.css' {
    const text: string;
    export default text;
}
