/** `pnpm janus`: starts Janus, which relays a robot's broadcast to any number of viewers. Ctrl-C ends it. */
import { JanusError, JanusServer } from '@farpoint/local-stack';
import {
  JANUS_HELP,
  JanusOptionError,
  type JanusScriptOptions,
  readJanusOptions,
} from './lib/janus-options.ts';

const options = optionsOrExit();
let server: JanusServer | null = null;
let stopping = false;

for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP'] as const) process.on(signal, () => void stop(0));

try {
  server = await JanusServer.start({
    ...options.server,
    onLine: (line) => {
      if (options.verbose) console.log(line);
    },
  });
  server.onEnd = (output) => {
    console.error(`Janus has ended\n${output}`);
    void stop(1);
  };
  const { url, adminKey, folder } = server;
  console.log(`
  Janus    ${url}   (configuration: ${folder})

  Robot    pnpm robot --broadcast-janus ${url} --broadcast-admin-key ${adminKey}
  Viewers  watch.html?janus=${url}

  Ctrl-C ends it.
`);
} catch (error) {
  if (!(error instanceof JanusError)) throw error;
  console.error(`pnpm janus: ${error.message}`);
  await stop(1);
}

async function stop(code: number): Promise<void> {
  if (stopping) return;
  stopping = true;
  await server?.stop();
  process.exit(code);
}

function optionsOrExit(): JanusScriptOptions {
  try {
    const read = readJanusOptions(process.argv.slice(2));
    if (read !== null) return read;
    process.stdout.write(JANUS_HELP);
    process.exit(0);
  } catch (error) {
    if (!(error instanceof JanusOptionError)) throw error;
    console.error(`pnpm janus: ${error.message}; \`pnpm janus --help\` lists the options`);
    process.exit(2);
  }
}
