/** Written in front of service-worker.js by the build. */
declare const BUILD: string;
/** The SHA-256 of each file, by its path. */
declare const FILES: Record<string, string>;
