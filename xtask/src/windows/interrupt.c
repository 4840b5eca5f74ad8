// interrupt.exe LINE: runs a command line, interrupts it as Ctrl-C does once its temporary file is there, and ends with its status.
#include <windows.h>

int main(int count, char **words) {
    STARTUPINFOA start = {.cb = sizeof start};
    PROCESS_INFORMATION child;
    WIN32_FIND_DATAA found;
    DWORD status = 255;
    int tries = 300;
    // Ctrl-C reaches the programs of a console; under Wine there is none yet.
    FreeConsole();
    AllocConsole();
    SetConsoleCtrlHandler(NULL, FALSE);
    if (count != 2 || !CreateProcessA(NULL, words[1], NULL, NULL, TRUE, 0, NULL, NULL, &start, &child)) return 254;
    while (FindFirstFileA(".unitvec-*", &found) == INVALID_HANDLE_VALUE && --tries) Sleep(100);
    SetConsoleCtrlHandler(NULL, TRUE);
    GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0);
    WaitForSingleObject(child.hProcess, 20000);
    GetExitCodeProcess(child.hProcess, &status);
    return tries ? (int)status : 253;
}
