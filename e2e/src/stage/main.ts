/** `pnpm page`: serves the page with a scripted robot, in each state that it has, to look at it without a robot. */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { repositoryRoot } from '@farpoint/local-stack';
import { STAGE_STATES } from '@farpoint/webxr/stage-states';
import { servePage } from './serve-page.ts';

const DEFAULT_PORT = 5180;
const states = Object.entries(STAGE_STATES);

const HELP = `pnpm page [--port PORT]

Serves the operator's page with a scripted robot: no robot, no signaling service. Its first page lists these states; each of
them can be operated. It shows what \`pnpm build\` has built last.

${states.map(([name, { what }]) => `  ${name.padEnd(17)} ${what}`).join('\n')}

  --port PORT  listens there (${DEFAULT_PORT}); 0: on any free port`;

const { values } = parseArgs({
  options: { port: { type: 'string', default: String(DEFAULT_PORT) }, help: { type: 'boolean', short: 'h' } },
});

if (values.help) {
  console.log(HELP);
  process.exit(0);
}
if (!existsSync(join(repositoryRoot, 'apps/webxr/dist-testing/index.html'))) {
  console.error('the page is not built: run `pnpm build`');
  process.exit(1);
}
const port = Number(values.port);
if (!Number.isInteger(port) || port < 0 || port > 65_535) {
  console.error(`--port: ${values.port} is no port`);
  process.exit(2);
}

const escaped = (text: string) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');
const LIST = `<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<meta name="color-scheme" content="dark light">
<title>States of the page</title>
<style>body { font: 16px/1.6 system-ui; margin: 2rem auto; max-width: 44rem; padding: 0 1rem } td { padding: 0 1rem 0 0 }</style>
<h1>States of the page</h1>
<p>Each has a scripted robot that answers as a robot does. In the console, <code>farpointStage</code> is the script.</p>
<table>
${states.map(([name, { what }]) => `<tr><td><a href="/?stage=${name}">${name}</a><td>${escaped(what)}`).join('\n')}
</table>
`;

const { origin } = await servePage((path) => (path === '/states' ? LIST : null), port);
console.log(`the page's states: ${origin}/states`);
