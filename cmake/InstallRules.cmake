# What lands under <prefix>: programs in bin (Targets.cmake), worlds and launch files in share/ensonify.
include(GNUInstallDirs)
install(DIRECTORY scenarios launch DESTINATION share/ensonify
        FILES_MATCHING PATTERN "*.yaml" PATTERN "README.md")
