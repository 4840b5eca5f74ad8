// Fetches the jobs from the program that serves this, runs them one by one, and sends back the words that each gives.

const fetched = async (path) => {
    const response = await fetch(path);
    if (!response.ok) throw Error(`${path}: ${response.status}`);
    return response;
};

const send = (path, body) => fetch(path, { method: "POST", body });

// `open` opens a device that runs jobs.
export async function run(base, open) {
    try {
        const jobs = await (await fetched(`${base}/jobs`)).json();
        const device = await open();
        for (const [number, job] of jobs.entries()) {
            const input = new Uint32Array(await (await fetched(`${base}/input/${number}`)).arrayBuffer());
            try {
                await send(`${base}/result/${number}`, await device.run(job, input));
            } catch (error) {
                await send(`${base}/fault/${number}`, String(error.message ?? error));
            }
        }
        await send(`${base}/done`, device.name);
    } catch (error) {
        await send(`${base}/failed`, String(error.stack ?? error));
    }
}
