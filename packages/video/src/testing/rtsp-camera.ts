/** A camera in a network, for tests: GStreamer's own RTSP server, which some makers build into theirs. */
import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import { join } from 'node:path';
import { createInterface } from 'node:readline';

/** The system's own: others do not see its packages. */
const PYTHON = '/usr/bin/python3';
const SCRIPT = join(import.meta.dirname, 'rtsp_camera.py');

export type RtspCoding = 'h264' | 'jpeg';

export class RtspCamera {
  readonly #child: ChildProcess;
  readonly port: number;

  private constructor(child: ChildProcess, port: number) {
    this.#child = child;
    this.port = port;
  }

  /** What it needs, in Debian. */
  static readonly PACKAGES = ['gir1.2-gst-rtsp-server-1.0', 'python3-gi'];

  static get suite(): { skip: boolean; note: string } {
    const note = `needs gst-rtsp-server (Debian: apt-get install ${RtspCamera.PACKAGES.join(' ')})`;
    const text = "import gi; gi.require_version('GstRtspServer', '1.0')";
    return { skip: spawnSync(PYTHON, ['-c', text]).status !== 0, note };
  }

  /**
   * Resolves once it listens.
   *
   * @param port 0: a free one
   * @param login the user and the password that it asks for
   */
  static async start(coding: RtspCoding = 'h264', port = 0, login: string[] = []): Promise<RtspCamera> {
    const child = spawn(PYTHON, [SCRIPT, String(port), coding, ...login], {
      stdio: ['ignore', 'pipe', 'inherit'],
    });
    process.once('exit', () => child.kill('SIGKILL'));
    const lines = createInterface({ input: child.stdout });
    const [line] = await Promise.race([
      once(lines, 'line') as Promise<[string]>,
      once(child, 'exit').then(([code]) => Promise.reject(new Error(`the camera has ended: ${code}`))),
    ]);
    return new RtspCamera(child, Number(line));
  }

  /** @param login `user:password` */
  url(login?: string): string {
    return `rtsp://${login === undefined ? '' : `${login}@`}127.0.0.1:${this.port}/stream`;
  }

  /** Resolves once it is gone, without a word to those who watch. */
  async kill(): Promise<void> {
    if (this.#child.exitCode !== null || this.#child.signalCode !== null) return;
    this.#child.kill('SIGKILL');
    await once(this.#child, 'exit');
  }
}
