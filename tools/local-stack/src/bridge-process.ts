import { freePorts } from './free-port.ts';
import { ManagedProcess } from './managed-process.ts';
import { type LocalStack, repositoryRoot } from './stack.ts';

export interface BridgeSpec {
  /** Free ports if absent. */
  ports?: BridgeProcess['ports'];
  /** More flags of the bridge program. */
  args?: string[];
  env?: Record<string, string>;
  onLine?: (name: string, line: string) => void;
}

/** The real bridge program beside a stack, on free ports. */
export class BridgeProcess {
  readonly ports: { control: number; telemetry: number; streaming: number };
  readonly adminUrl: string;
  readonly process: ManagedProcess;

  private constructor(ports: BridgeProcess['ports'], adminUrl: string, started: ManagedProcess) {
    this.ports = ports;
    this.adminUrl = adminUrl;
    this.process = started;
  }

  /** @throws {Error} with the program's last lines if it does not start */
  static async start(stack: LocalStack, spec: BridgeSpec = {}): Promise<BridgeProcess> {
    const [admin, ...free] = (await freePorts(4)) as [number, number, number, number];
    const { control, telemetry, streaming } = spec.ports ?? {
      control: free[0],
      telemetry: free[1],
      streaming: free[2],
    };
    const adminUrl = `http://127.0.0.1:${admin}`;
    const started = await ManagedProcess.start({
      name: 'bridge',
      command: [
        'node',
        'apps/bridge/src/main.ts',
        '--signaling',
        `ws://127.0.0.1:${stack.ports.referenceClient}`,
        '--control-port',
        String(control),
        '--telemetry-port',
        String(telemetry),
        '--streaming-port',
        String(streaming),
        '--admin-port',
        String(admin),
        ...(spec.args ?? []),
      ],
      cwd: repositoryRoot,
      env: spec.env,
      readyUrl: `${adminUrl}/healthz`,
      onLine: spec.onLine,
    });
    return new BridgeProcess({ control, telemetry, streaming }, adminUrl, started);
  }

  /** The address as it is given to the page. */
  get address(): string {
    const { control, telemetry, streaming } = this.ports;
    return `ws://localhost:${control},${telemetry},${streaming}`;
  }

  async stop(): Promise<void> {
    await this.process.stop();
  }
}
