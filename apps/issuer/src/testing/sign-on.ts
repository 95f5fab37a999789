/** An issuer and its provider, as real programs on loopback, for tests. */
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeSigningKey } from '@farpoint/grants';
import { freePorts, ManagedProcess, programPath, repositoryRoot } from '@farpoint/local-stack';
import { CLIENT_ID, LoginProvider, type LoginProviderOptions } from './login-provider.ts';

export interface SignOnOptions
  extends Pick<LoginProviderOptions, 'people' | 'claimsInIdToken' | 'clientSecret' | 'forge'> {
  /** An empty folder for keys and configuration. */
  folder: string;
  /** The issuer's rules, as in its configuration. */
  rules: readonly object[];
  /** Pages that grants may be sent to. */
  pages: readonly string[];
  /** More options of the issuer, as in its configuration. */
  more?: Readonly<Record<string, unknown>>;
  /** The issuer's own log. */
  onLine?: (line: string) => void;
}

export class SignOn {
  /** The issuer's address. */
  readonly url: string;
  /** Where its `/healthz` and `/metrics` are. */
  readonly adminUrl: string;
  /** A file of public keys, for `--grant-keys`. */
  readonly keysFile: string;
  readonly #options: SignOnOptions;
  #provider: LoginProvider;
  #issuer: ManagedProcess | null = null;

  private constructor(options: SignOnOptions, ports: readonly [number, number], provider: LoginProvider) {
    this.#options = options;
    this.url = `http://localhost:${ports[0]}`;
    this.adminUrl = `http://127.0.0.1:${ports[1]}`;
    this.keysFile = join(options.folder, 'grant-keys.json');
    this.#provider = provider;
  }

  static async start(options: SignOnOptions): Promise<SignOn> {
    const ports = (await freePorts(2)) as [number, number];
    const provider = await LoginProvider.start({
      ...options,
      callbackUrl: `http://localhost:${ports[0]}/callback`,
    });
    const signOn = new SignOn(options, ports, provider);
    await signOn.#writeFiles();
    await signOn.startIssuer();
    return signOn;
  }

  /** Where operators sign in. */
  get signInUrl(): string {
    return `${this.url}/sign-in`;
  }

  get provider(): LoginProvider {
    return this.#provider;
  }

  async startIssuer(): Promise<void> {
    this.#issuer = await ManagedProcess.start({
      name: 'issuer',
      command: ['node', programPath('issuer'), '--config', join(this.#options.folder, 'issuer.yaml')],
      ...{ cwd: repositoryRoot, readyUrl: `${this.adminUrl}/healthz` },
      onLine: (_, line) => this.#options.onLine?.(line),
    });
  }

  async stopIssuer(): Promise<void> {
    await this.#issuer?.stop();
    this.#issuer = null;
  }

  /** The provider again at the same address: without its sessions, and with other keys. */
  async restartProvider(): Promise<void> {
    const { port } = this.#provider;
    this.#provider = await LoginProvider.start({
      ...this.#options,
      callbackUrl: `${this.url}/callback`,
      port,
    });
  }

  async stop(): Promise<void> {
    await this.stopIssuer();
    await this.#provider.close();
  }

  async #writeFiles(): Promise<void> {
    const { folder, pages, rules, more, clientSecret = null } = this.#options;
    mkdirSync(folder, { recursive: true });
    const { secretJwk, publicJwk } = await makeSigningKey();
    const key = join(folder, 'grant-key.json');
    writeFileSync(key, JSON.stringify(secretJwk), { mode: 0o600 });
    writeFileSync(this.keysFile, JSON.stringify({ keys: [publicJwk] }));
    const issuer = {
      ...{ url: this.url, port: Number(new URL(this.url).port), pages, key, rules },
      ...{
        provider: this.#provider.url,
        clientId: CLIENT_ID,
        ...(clientSecret === null ? {} : { clientSecret }),
      },
      ...{ admin: { port: Number(new URL(this.adminUrl).port) }, log: { format: 'json' }, ...more },
    };
    // JSON is valid YAML.
    writeFileSync(join(folder, 'issuer.yaml'), JSON.stringify({ issuer }));
  }
}
