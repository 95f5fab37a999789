import { existsSync } from 'node:fs';
import { delimiter, join } from 'node:path';
import { type Browser, chromium, type LaunchOptions } from '@playwright/test';

/** The command that installs a missing browser. */
export const CHROMIUM_REMEDY = 'npx -y pnpm@12 --dir e2e exec playwright install --with-deps chromium';

const PROGRAM_NAMES = ['chromium', 'chromium-browser', 'google-chrome-stable', 'google-chrome', 'chrome'];
const OTHER_PLACES = [
  '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome',
  '/Applications/Chromium.app/Contents/MacOS/Chromium',
  'C:\\Program Files\\Google\\Chrome\\Application\\chrome.exe',
];

/**
 * The browser for tests and benchmarks: `FARPOINT_CHROMIUM`, else Playwright's own, else one installed on this machine.
 *
 * @returns its path, or `null` if there is none
 */
export function findChromium(): string | null {
  const named = process.env.FARPOINT_CHROMIUM;
  if (named !== undefined && named !== '') return existsSync(named) ? named : null;
  const own = chromium.executablePath();
  if (own !== '' && existsSync(own)) return own;
  return findProgram(PROGRAM_NAMES, OTHER_PLACES);
}

/**
 * Chromium without its windows: the same engine, which leaves more of a small machine's processor to the page, because
 * nothing is composed for a screen.
 *
 * @returns its path, or `null` if there is none, or `FARPOINT_CHROMIUM` names a browser
 */
export function findHeadlessShell(): string | null {
  if ((process.env.FARPOINT_CHROMIUM ?? '') !== '') return null;
  return findProgram(['chromium-headless-shell', 'chrome-headless-shell'], playwrightsShells());
}

/** Where Playwright puts its own, beside its Chromium. */
function playwrightsShells(): string[] {
  const own = /^(?<folder>.*)chromium-(?<build>\d+)/.exec(chromium.executablePath())?.groups;
  if (own === undefined) return [];
  const folder = `${own.folder}chromium_headless_shell-${own.build}`;
  return ['linux', 'linux64', 'mac', 'mac-arm64', 'mac-x64', 'win64'].flatMap((platform) =>
    ['headless_shell', 'chrome-headless-shell', 'chrome-headless-shell.exe'].flatMap((name) => [
      join(folder, `chrome-${platform}`, name),
      join(folder, `chrome-headless-shell-${platform}`, name),
    ]),
  );
}

/** Launch options that work as root, without a GPU, and without internet access. */
export function chromiumLaunchOptions(executablePath = findChromium()): LaunchOptions {
  if (executablePath === null) {
    throw new Error(`no Chromium on this machine: run \`${CHROMIUM_REMEDY}\``);
  }
  return {
    executablePath,
    args: [
      ...(process.getuid?.() === 0 ? ['--no-sandbox'] : []),
      '--use-gl=angle',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      // Software compositing beside software WebGL: the window need not be drawn by the same emulated GPU.
      '--disable-gpu-compositing',
      '--disable-gpu-rasterization',
      '--no-first-run',
      // A page in the background of a test must run as fast as one that a person looks at.
      '--disable-background-timer-throttling',
      '--disable-renderer-backgrounding',
      '--disable-backgrounding-occluded-windows',
      // Loopback candidates must be addresses, not mDNS names, because containers have no mDNS responder.
      '--disable-features=WebRtcHideLocalIpsWithMdns',
    ],
  };
}

/** Starts the browser with {@link chromiumLaunchOptions}, for what is no Playwright test. */
export function launchChromium(): Promise<Browser> {
  return chromium.launch(chromiumLaunchOptions());
}

/**
 * Finds the first of these programs on PATH, else the first of the other places that exists.
 *
 * @returns its path, or `null`
 */
export function findProgram(names: readonly string[], otherPlaces: readonly string[] = []): string | null {
  const folders = (process.env.PATH ?? '').split(delimiter);
  const candidates = names.flatMap((name) => folders.map((folder) => join(folder, name)));
  return [...candidates, ...otherPlaces].find((path) => existsSync(path)) ?? null;
}
