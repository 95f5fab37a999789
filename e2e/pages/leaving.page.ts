/** A page that the browser keeps in its back/forward cache, and its signaling service. */
import type { Page, WebSocketRoute } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';

type Message = Record<string, unknown>;

/** A service with one robot. It says of each request that it has passed it on. */
class Service {
  /** What pages have sent over each socket. */
  readonly sockets: Message[][] = [];
  /** Sockets that pages have closed. */
  readonly closed = new Set<WebSocketRoute>();
  #told: ((message: Message) => void)[] = [];

  static async open(page: Page): Promise<Service> {
    const service = new Service();
    await page.routeWebSocket(/\/operator$/, (socket) => service.#take(socket));
    return service;
  }

  /** The next message of this type. */
  next(type: string): Promise<Message> {
    return new Promise((resolve) => {
      this.#told.push((message) => {
        if (message.type === type) resolve(message);
      });
    });
  }

  #take(socket: WebSocketRoute): void {
    const messages: Message[] = [];
    this.sockets.push(messages);
    const say = (message: Message) => socket.send(JSON.stringify(message));
    socket.onMessage((text) => {
      const message = JSON.parse(String(text)) as Message;
      messages.push(message);
      if (message.type === 'operator.hello') {
        say({ type: 'operator.welcome', iceServers: [] });
        say({ type: 'robots', robots: [{ id: 'rover', name: 'Rover' }] });
      }
      if (message.type === 'session.open') {
        say({ type: 'session.opened', session: `session-${this.sockets.length}`, robotId: 'rover' });
        // Its words are shown at once: then the page has read that the session is there.
        say({ type: 'error', code: 'rate-limited', message: `Opened ${this.sockets.length}` });
      }
      for (const told of this.#told) told(message);
    });
    socket.onClose(() => {
      this.closed.add(socket);
      void socket.close();
    });
  }
}

test('a page that the browser caches leaves the robot at once, and reconnects when it is restored', async ({
  stage,
}) => {
  const { page } = stage;
  const service = await Service.open(page);
  const transition = (type: 'pagehide' | 'pageshow', persisted: boolean) =>
    page.evaluate(
      ([type, persisted]) => void window.dispatchEvent(new PageTransitionEvent(type, { persisted })),
      [type, persisted] as const,
    );
  let asked = service.next('session.open');
  await stage.openOwn({ robot: 'rover' });
  for (const socket of [1, 2, 3]) {
    expect(await asked).toEqual({ type: 'session.open', robotId: 'rover' });
    await expect(page.getByText(`Opened ${socket}`)).toBeVisible();
    const left = service.next('session.close');
    await transition('pagehide', true);
    expect(await stage.state()).toMatchObject({ session: 'none', signaling: 'stopped' });
    expect(await left).toEqual({ type: 'session.close', session: `session-${socket}` });
    // A page in the cache does nothing, and a load is no return.
    await transition('pageshow', false);
    await stage.run(10_000);
    expect(service.sockets).toHaveLength(socket);
    expect(await stage.state()).toMatchObject({ session: 'none', signaling: 'stopped' });
    asked = service.next('session.open');
    await transition('pageshow', true);
  }
  await asked;
  await expect(page.getByText('Opened 4')).toBeVisible();
  expect((await stage.state()).session).toBe('opening');
  expect(service.closed.size).toBe(3);
  // Without a session the list is shown, and with it what robots say of themselves.
  const each = ['operator.hello', 'session.open', 'session.close', 'statuses.watch'];
  expect(service.sockets.map((messages) => messages.map(({ type }) => type))).toEqual([
    ...[each, each, each],
    each.slice(0, 2),
  ]);
});
